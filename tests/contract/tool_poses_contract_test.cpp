#include <gtest/gtest.h>

#include <chrono>
#include <set>
#include <thread>

#include "hal/api/tool_pose_source.h"
#include "tests/contract/device_cases.h"

namespace orthonav {
namespace {

using orthonav::test::DeviceCase;

/// The promises of every device that measures tools itself.
class ToolPosesContract : public ::testing::TestWithParam<DeviceCase> {
 protected:
  void SetUp() override {
    ASSERT_NE(headset_, nullptr);
    ASSERT_NE(headset_->tool_poses(), nullptr);
  }
  /// Calls `use` with each of the next poses, at most this many; false: there are no more.
  template <class Use>
  bool each(const Use& use) {
    constexpr int kMost = 10;
    constexpr int kMaxCalls = 20000;
    ToolPoses poses;
    int came = 0;
    for (int call = 0; call < kMaxCalls && came < kMost; ++call) {
      const auto next = headset_->tool_poses()->next(poses);
      EXPECT_TRUE(next.ok()) << next.error().message;
      if (!next || *next == Next::kEnd) {
        return false;
      }
      if (*next == Next::kNone) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        continue;
      }
      ++came;
      use(poses);
    }
    return true;
  }

  std::unique_ptr<Headset> headset_ = GetParam().open();
};

TEST_P(ToolPosesContract, HasAName) { EXPECT_FALSE(headset_->name().empty()); }

TEST_P(ToolPosesContract, NamesEachToolOnceAndTheSameAtEveryCall) {
  ToolPoseSource* const source = headset_->tool_poses();
  EXPECT_EQ(headset_->tool_poses(), source);
  const auto names = source->names();
  ASSERT_FALSE(names.empty());
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  each([](const ToolPoses&) {});
  const auto again = source->names();
  EXPECT_EQ(std::vector<std::string>(again.begin(), again.end()),
            std::vector<std::string>(names.begin(), names.end()));
}

TEST_P(ToolPosesContract, DeliversThemInOrderMeasuredOrLostAndNoneFromTheFuture) {
  const std::size_t names = headset_->tool_poses()->names().size();
  std::optional<FrameHeader> last;
  int measured = 0;
  each([&](const ToolPoses& poses) {
    EXPECT_LE(poses.time, headset_->clock().now());
    EXPECT_GE(poses.sequence, 0);
    if (last) {
      EXPECT_GT(poses.time, last->time);
      EXPECT_GT(poses.sequence, last->sequence);
      EXPECT_GE(poses.map_epoch, last->map_epoch);
    }
    last = poses;
    ASSERT_EQ(poses.tools.size(), names);
    for (const auto& tool : poses.tools) {
      if (tool.status == PoseStatus::kLost) {
        continue;
      }
      ++measured;
      EXPECT_EQ(tool.status, PoseStatus::kMeasured);
      EXPECT_EQ(tool.time, poses.time);
      EXPECT_LE(orthonormality_error(tool.value.rotation()), 1e-9);
      EXPECT_GT(tool.value.rotation().determinant(), 0.0);
      EXPECT_GT(translation_sigma_m(tool.covariance), 0.0) << "no pose is exact";
    }
  });
  EXPECT_GT(measured, 0);
}

TEST_P(ToolPosesContract, ReusesTheBufferOfItsPoses) {
  std::set<const void*> buffers;
  each([&](const ToolPoses& poses) { buffers.insert(poses.tools.data()); });
  EXPECT_EQ(buffers.size(), 1u);
}

TEST_P(ToolPosesContract, EndsForGood) {
  // A live device goes on for as long as its sender does.
  constexpr int kMostTimes = 10;
  bool more = true;
  for (int i = 0; i < kMostTimes && more; ++i) {
    more = each([](const ToolPoses&) {});
  }
  if (more) {
    GTEST_SKIP() << "goes on";
  }
  ToolPoses poses;
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(headset_->tool_poses()->next(poses).value(), Next::kEnd);
  }
}

TEST_P(ToolPosesContract, ShowsNothingBeforeItIsSubmitted) {
  EXPECT_GE(headset_->display_latency(), Duration::zero());
}

std::vector<DeviceCase> measuring() {
  std::vector<DeviceCase> all = orthonav::test::device_cases();
  std::erase_if(all, [](const DeviceCase& device) { return !device.measures_tools; });
  return all;
}

// A device with cameras alone has no case here.
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(ToolPosesContract);
INSTANTIATE_TEST_SUITE_P(Every, ToolPosesContract, ::testing::ValuesIn(measuring()),
                         [](const auto& device) { return device.param.name; });

}  // namespace
}  // namespace orthonav
