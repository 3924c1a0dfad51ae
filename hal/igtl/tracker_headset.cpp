#include "hal/igtl/tracker_headset.h"

#include <thread>
#include <utility>

#include "base/joined.h"
#include "hal/api/absent_devices.h"
#include "hal/igtl/pose_receiver.h"
#include "hal/net/host_port.h"

namespace orthonav::igtl {
namespace {

/// Latency of an ordinary monitor on which the operation is watched; a tracker has no display.
constexpr Duration kDisplayLatency = std::chrono::milliseconds(16);

class Poses final : public ToolPoseSource {
 public:
  Poses(PoseReceiver& receiver, const std::vector<NamedTransform>& tools) : receiver_(receiver) {
    for (const NamedTransform& each : tools) {
      names_.push_back(each.tool);
    }
  }

 private:
  [[nodiscard]] std::span<const std::string> do_names() const override { return names_; }
  Result<Next> do_next(ToolPoses& poses) override { return receiver_.next(poses); }

  PoseReceiver& receiver_;
  std::vector<std::string> names_;
};

/// The tracker does not move: its frame is both Rig and World.
class StandingHead final : public HeadTracker {
 public:
  explicit StandingHead(const PoseReceiver& receiver) : receiver_(receiver) {}

 private:
  [[nodiscard]] Tracked<Transform<World, Rig>> do_world_from_rig(Timestamp at) const override {
    Tracked<Transform<World, Rig>> answer;
    answer.time = at;
    if (const auto newest = receiver_.newest()) {
      answer.status = at <= *newest ? PoseStatus::kMeasured : PoseStatus::kPredicted;
    }
    return answer;
  }
  [[nodiscard]] std::optional<Timestamp> do_newest_measurement() const override {
    return receiver_.newest();
  }

  const PoseReceiver& receiver_;
};

class TrackerHeadset final : public Headset {
 public:
  TrackerHeadset(std::string name, std::unique_ptr<PoseReceiver> receiver,
                 const std::vector<NamedTransform>& tools)
      : name_(std::move(name)),
        receiver_(std::move(receiver)),
        poses_(*receiver_, tools),
        head_(*receiver_) {}
  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] const Clock& clock() const override { return receiver_->clock(); }
  [[nodiscard]] StereoCamera* cameras() override { return nullptr; }
  [[nodiscard]] ToolPoseSource* tool_poses() override { return &poses_; }
  [[nodiscard]] HeadTracker& head() override { return head_; }
  [[nodiscard]] Clicker& clicker() override { return button_; }
  [[nodiscard]] Voice& voice() override { return voice_; }
  [[nodiscard]] Duration display_latency() const override { return kDisplayLatency; }
  [[nodiscard]] std::optional<ConnectionStatistics> connection() const override {
    return receiver_->statistics();
  }

 private:
  std::string name_;
  std::unique_ptr<PoseReceiver> receiver_;
  Poses poses_;
  StandingHead head_;
  AbsentClicker button_;
  AbsentVoice voice_;
};

}  // namespace

Result<std::unique_ptr<Headset>> open_tracker(const TrackerOptions& options) {
  const std::string name =
      "igtl://" + net::before_port(options.host) + ":" + std::to_string(options.port);
  const auto endpoint = net::resolve(options.host);
  if (!endpoint) {
    return Error{name + ": " + endpoint.error().message, endpoint.error().code};
  }
  auto receiver = std::make_unique<PoseReceiver>(*endpoint, options);
  const HostTime deadline = HostClock::now() + options.open_within;
  while (!receiver->has_heard()) {
    if (HostClock::now() >= deadline) {
      std::vector<std::string> asked;
      for (const NamedTransform& each : options.tools) {
        asked.push_back(each.transform);
      }
      return Error{name + ": no pose of " + joined(asked, ", ") + " within " +
                       std::to_string(options.open_within / std::chrono::seconds(1)) +
                       " s: " + receiver->trouble(),
                   ErrorCode::kUnavailable};
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return std::unique_ptr<Headset>(
      std::make_unique<TrackerHeadset>(name, std::move(receiver), options.tools));
}

HeadsetScheme scheme() {
  const auto check = [](const std::string& rest) {
    const auto options = tracker_options_of(rest);
    return options ? Status{} : Status(options.error());
  };
  const auto open = [](const std::string& rest,
                       const std::vector<std::string>& /*phrases*/) -> Result<OpenedDevice> {
    const auto options = tracker_options_of(rest);
    if (!options) {
      return options.error();
    }
    auto opened = open_tracker(*options);
    if (!opened) {
      return opened.error();
    }
    return OpenedDevice{std::move(*opened), {}};
  };
  return {"igtl", "igtl://HOST", check, open};
}

}  // namespace orthonav::igtl
