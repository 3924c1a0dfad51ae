// A device's statement of its head pose's own error.
#include <gmock/gmock.h>

#include <limits>
#include <optional>

#include "hal/sim/cameras/hololens2.h"
#include "hal/sim/sim_headset.h"

namespace orthonav::sim::head_statement_test {
namespace {

using ::testing::HasSubstr;

TEST(HeadStatement, OfTheSimulatedHeadsetIsItsNoiseTimesTheFactorToldOf) {
  std::optional<Transform<World, Rig>> reported;
  for (const double factor : {1.0, 2.0}) {
    SimOptions options;
    options.render = false;
    options.told_sd_factor = factor;
    auto headset = SimHeadset::open({}, options);
    ASSERT_TRUE(headset.ok()) << headset.error().message;
    StereoFrame frame;
    ASSERT_TRUE((*headset)->cameras()->next(frame).ok());
    ASSERT_TRUE(frame.head_covariance.has_value());
    const ErrorModel& model = options.error_model;
    for (std::size_t i = 0; i < 6; ++i) {
      const double sd = factor * (i < 3 ? model.head_pose_noise_m : model.head_pose_noise_rad);
      EXPECT_DOUBLE_EQ((*frame.head_covariance)[7 * i], sd * sd);
    }
    EXPECT_EQ(reported.value_or(*frame.world_from_rig), *frame.world_from_rig)
        << "what is told changes nothing that is drawn";
    reported = frame.world_from_rig;
    frame.clear();
    EXPECT_FALSE(frame.head_covariance.has_value());
  }
}

/// A camera pair with one statement about its head.
class Stating final : public StereoCamera {
 public:
  explicit Stating(const PoseCovariance& covariance) : covariance_(covariance) {}

 private:
  [[nodiscard]] const StereoCalibration& do_calibration() const override { return calibration_; }
  Result<Next> do_next(StereoFrame& frame) override {
    for (auto [image, camera] : {std::pair{&frame.left, &calibration_.left},
                                 std::pair{&frame.right, &calibration_.right}}) {
      image->width_px = camera->width_px();
      image->height_px = camera->height_px();
      image->pixels.resize(camera->lookup().size());
    }
    frame.sequence = 1;
    frame.world_from_rig = Transform<World, Rig>();
    frame.head_covariance = covariance_;
    return Next::kFrame;
  }
  StereoCalibration calibration_ = hololens2_calibration();
  PoseCovariance covariance_;
};

TEST(HeadStatement, IsRefusedWhereItIsNoCovariance) {
  const auto next = [](std::size_t entry, double value) {
    PoseCovariance covariance{};
    covariance[entry] = value;
    StereoFrame frame;
    return Stating(covariance).next(frame);
  };
  EXPECT_TRUE(next(0, 1e-6).ok());
  EXPECT_TRUE(next(1, -1e-7).ok()) << "off the diagonal";
  for (const auto& refused : {next(7, -1e-6), next(3, std::numeric_limits<double>::infinity())}) {
    ASSERT_FALSE(refused.ok());
    EXPECT_THAT(refused.error().message, HasSubstr("covariance of the head's pose"));
  }
}

}  // namespace
}  // namespace orthonav::sim::head_statement_test
