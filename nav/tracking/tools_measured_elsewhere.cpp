#include "nav/tracking/tools_measured_elsewhere.h"

#include <algorithm>
#include <utility>

#include "base/check.h"
#include "base/joined.h"

namespace orthonav::nav {
namespace {

class TrackerOfPoses final : public ToolTracker {
 public:
  TrackerOfPoses(std::vector<ToolGeometry> tools, std::vector<std::size_t> tool_of)
      : tools_(std::move(tools)), tool_of_(std::move(tool_of)), states_(tools_.size()) {}

  std::span<const ToolState> track(const StereoFrame& /*frame*/) override {
    ORTHONAV_CHECK(false);  // it finds nothing in pictures
    return {};
  }
  std::span<const ToolState> take(const ToolPoses& poses) override {
    for (std::size_t i = 0; i < states_.size(); ++i) {
      states_[i] = {};
      states_[i].tool = i;
      states_[i].world_from_marker.time = poses.time;
    }
    for (std::size_t i = 0; i < tool_of_.size() && i < poses.tools.size(); ++i) {
      const TrackedPose& measured = poses.tools[i];
      if (measured.status == PoseStatus::kMeasured) {
        ToolState& state = states_[tool_of_[i]];
        state.world_from_marker = measured;
        state.rig_from_marker = {measured.value.rotation(), measured.value.translation()};
        state.pair = PairPose{state.rig_from_marker, measured.covariance, 0.0};
      }
    }
    return states_;
  }
  [[nodiscard]] std::span<const ToolGeometry> tools() const override { return tools_; }
  [[nodiscard]] double tag_size_difference_sd(std::size_t /*tool*/,
                                              std::size_t /*other*/) const override {
    return 0.0;  // there are no tags
  }

 private:
  std::vector<ToolGeometry> tools_;
  std::vector<std::size_t> tool_of_;  ///< for each tool that the device names
  std::vector<ToolState> states_;
};

}  // namespace

Result<std::unique_ptr<ToolTracker>> create_tracker_of_poses(std::span<const std::string> measured,
                                                             std::vector<ToolGeometry> tools) {
  if (const auto problems = problems_of(tools); !problems.empty()) {
    return Error{"tools: " + joined(problems)};
  }
  std::vector<std::size_t> tool_of;
  for (const std::string& name : measured) {
    const auto tool = std::find_if(tools.begin(), tools.end(),
                                   [&](const ToolGeometry& each) { return each.name == name; });
    if (tool == tools.end()) {
      std::vector<std::string> names;
      for (const ToolGeometry& each : tools) {
        names.push_back(each.name);
      }
      return Error{"tools: the headset measures \"" + name +
                   "\", and no tool is named so (there are: " + joined(names) + ")"};
    }
    tool_of.push_back(static_cast<std::size_t>(tool - tools.begin()));
  }
  return std::unique_ptr<ToolTracker>(
      std::make_unique<TrackerOfPoses>(std::move(tools), std::move(tool_of)));
}

}  // namespace orthonav::nav
