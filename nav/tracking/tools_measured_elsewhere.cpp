#include "nav/tracking/tools_measured_elsewhere.h"

#include <algorithm>
#include <utility>

#include "base/joined.h"
#include "nav/tracking/tag_pose.h"

namespace orthonav::nav {
namespace {

class TrackerOfPoses final : public ToolTracker {
 public:
  TrackerOfPoses(std::vector<ToolGeometry> tools, std::vector<std::size_t> tool_of)
      : tools_(std::move(tools)), tool_of_(std::move(tool_of)), states_(tools_.size()) {}

  std::span<const ToolState> track(const StereoFrame& frame) override {
    for (std::size_t i = 0; i < states_.size(); ++i) {
      states_[i] = {};
      states_[i].tool = i;
      states_[i].world_from_marker.time = frame.time;
    }
    if (!frame.world_from_rig) {
      return states_;
    }
    for (const MeasuredTool& measured : frame.tools) {
      if (measured.tool < tool_of_.size()) {
        take(measured, frame);
      }
    }
    return states_;
  }
  [[nodiscard]] std::span<const ToolGeometry> tools() const override { return tools_; }
  [[nodiscard]] double tag_size_difference_sd(std::size_t /*tool*/,
                                              std::size_t /*other*/) const override {
    return 0.0;  // there are no tags
  }
  [[nodiscard]] bool follows_tools() const override { return false; }

 private:
  void take(const MeasuredTool& measured, const StereoFrame& frame) {
    ToolState& state = states_[tool_of_[measured.tool]];
    const Transform<World, Rig>& world_from_rig = *frame.world_from_rig;
    state.rig_from_marker = measured.rig_from_marker;
    state.world_from_marker = {world_from_rig * measured.rig_from_marker, frame.time,
                               PoseStatus::kMeasured,
                               rotated(measured.covariance, world_from_rig.rotation())};
    state.pair = PairPose{measured.rig_from_marker, measured.covariance, 0.0};
    add_head(state, frame);
  }

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
