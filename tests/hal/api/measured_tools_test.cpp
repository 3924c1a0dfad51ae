#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "hal/api/devices.h"

namespace orthonav::measured_tools_test {
namespace {

using ::testing::HasSubstr;

/// Measures tools itself and has no cameras.
class Tracker : public StereoCamera {
 public:
  std::vector<MeasuredTool> tools;

 private:
  [[nodiscard]] const StereoCalibration& do_calibration() const override { return calibration_; }
  [[nodiscard]] std::span<const std::string> do_measured_tools() const override { return names_; }
  Result<Next> do_next(StereoFrame& frame) override {
    frame.clear();
    frame.sequence = ++sequence_;
    frame.time = Timestamp(std::chrono::milliseconds(sequence_));
    frame.tools = tools;
    return Next::kFrame;
  }
  StereoCalibration calibration_;
  std::vector<std::string> names_ = {"pointer", "guide"};
  std::int64_t sequence_ = 0;
};

MeasuredTool tool(std::size_t index) {
  MeasuredTool out;
  out.tool = index;
  out.covariance[0] = 1e-8;
  return out;
}

/// The error with which a frame with these tools is refused; empty if it is passed on.
std::string refusal(const std::vector<MeasuredTool>& tools) {
  Tracker tracker;
  tracker.tools = tools;
  StereoFrame frame;
  const auto next = tracker.next(frame);
  EXPECT_EQ(frame.tools.size(), next ? tools.size() : 0u) << "nothing of it is passed on";
  return next ? "" : next.error().message;
}

TEST(MeasuredTools, ComeWithFramesThatNeedNoImages) {
  EXPECT_EQ(refusal({tool(0), tool(1)}), "");
  EXPECT_EQ(refusal({}), "");
  EXPECT_FALSE(Tracker().calibration().has_images());
}

TEST(MeasuredTools, ThatCantBeAreReportedByNameAndNotPassedOn) {
  EXPECT_THAT(refusal({tool(2)}), HasSubstr("measures tool 2, names 2"));
  EXPECT_THAT(refusal({tool(1), tool(0), tool(1)}), HasSubstr("pose of guide"));
  MeasuredTool mirrored = tool(0);
  mirrored.rig_from_marker = {Mat3{{{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}}, {}};
  EXPECT_THAT(refusal({mirrored}), HasSubstr("pose of pointer"));
  MeasuredTool unsure = tool(1);
  unsure.covariance[7] = -1e-12;
  EXPECT_THAT(refusal({unsure}), HasSubstr("negative variance"));
  unsure.covariance[7] = std::numeric_limits<double>::infinity();
  EXPECT_THAT(refusal({unsure}), HasSubstr("not finite"));
}

}  // namespace
}  // namespace orthonav::measured_tools_test
