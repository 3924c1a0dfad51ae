#include "hal/sim/sim_headset.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <utility>

#include "hal/sim/cameras/hololens2.h"
#include "hal/sim/cameras/imperfect.h"
#include "hal/sim/cameras/sim_cameras.h"
#include "hal/sim/cameras/sim_depth.h"
#include "hal/sim/room/surface_field.h"
#include "hal/sim/room/tag_flaws.h"
#include "hal/sim/sim_room.h"

namespace orthonav::sim {
namespace {

/// From submitting a frame to its light: one refresh at 60 Hz.
constexpr Duration kDisplayLatency = std::chrono::milliseconds(16);

class SimHeadTracker final : public HeadTracker {
 public:
  explicit SimHeadTracker(SimRoom& room) : room_(room) {}

 private:
  [[nodiscard]] Tracked<Transform<World, Rig>> do_world_from_rig(Timestamp at) const override {
    const MutexLock lock(room_.mutex);
    return room_.head.at(at);
  }
  [[nodiscard]] std::optional<Timestamp> do_newest_measurement() const override {
    const MutexLock lock(room_.mutex);
    return room_.head.newest();
  }
  SimRoom& room_;
};

/// Moves the events up to a time from one list to another.
template <class Event>
void hand_over(std::vector<Event>& from, Timestamp until, std::vector<Event>& to) {
  const auto end = std::find_if(from.begin(), from.end(),
                                [until](const Event& event) { return event.time > until; });
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(end));
  from.erase(from.begin(), end);
}

class SimClicker final : public Clicker {
 public:
  explicit SimClicker(SimRoom& room) : room_(room) {}

 private:
  Status do_poll(Timestamp until, std::vector<ClickerEvent>& events) override {
    const MutexLock lock(room_.mutex);
    hand_over(room_.simulation.clicks(), until, events);
    return {};
  }
  SimRoom& room_;
};

class SimVoice final : public Voice {
 public:
  explicit SimVoice(SimRoom& room) : room_(room) {}

 private:
  Status do_poll(Timestamp until, std::vector<Phrase>& phrases) override {
    const MutexLock lock(room_.mutex);
    hand_over(room_.simulation.phrases(), until, phrases);
    return {};
  }
  SimRoom& room_;
};

class SimWearer final : public Wearer {
 public:
  explicit SimWearer(SimRoom& room) : room_(room) {}
  void see(const WornFrame& frame) override {
    const MutexLock lock(room_.mutex);
    // The display draws for the pose that it predicted when the frame was submitted.
    const auto believed = room_.head.at(frame.display_time, frame.display_time - kDisplayLatency);
    if (believed.status != PoseStatus::kLost) {
      room_.simulation.show(frame, believed.value);
    }
  }

 private:
  SimRoom& room_;
};

class SimulatedHeadset final : public SimHeadset {
 public:
  SimulatedHeadset(RoomDescription room, const SimOptions& options, StereoCalibration reported,
                   StereoCalibration actual)
      : options_(options),
        actual_(std::move(actual)),
        room_(std::move(room), options, between_cameras(reported)),
        cameras_(room_, options, std::move(reported), actual_),
        head_(room_),
        clicker_(room_),
        voice_(room_),
        wearer_(room_) {
    for (const DepthStream stream : options.depth) {
      depth_.push_back(std::make_unique<SimDepth>(
          room_, options,
          stream == DepthStream::kAhat ? hololens2_ahat() : hololens2_long_throw()));
    }
  }

  [[nodiscard]] std::string name() const override { return "simulated operating room"; }
  [[nodiscard]] const Clock& clock() const override { return room_.clock; }
  [[nodiscard]] StereoCamera* cameras() override { return &cameras_; }
  [[nodiscard]] HeadTracker& head() override { return head_; }
  [[nodiscard]] Clicker& clicker() override { return clicker_; }
  [[nodiscard]] Voice& voice() override { return voice_; }
  [[nodiscard]] Duration display_latency() const override { return kDisplayLatency; }
  [[nodiscard]] Wearer* wearer() override { return &wearer_; }
  [[nodiscard]] std::vector<DepthCamera*> depth_cameras() override { return borrowed(depth_); }

  // Only the thread that takes the pairs adds to the truth, and only that thread reads it.
  [[nodiscard]] const Truth& truth() const override ORTHONAV_NO_THREAD_SAFETY_ANALYSIS {
    return room_.simulation.truth();
  }
  [[nodiscard]] RoomState state() const override {
    const MutexLock lock(room_.mutex);
    RoomState state;
    room_.simulation.state_at(room_.last_frame, state);
    return state;
  }
  [[nodiscard]] Transform<World, Room> world_from_room() const override {
    const MutexLock lock(room_.mutex);
    return room_.simulation.world_from_room(room_.last_frame);
  }
  [[nodiscard]] Transform<World, World> actual_from_reported(Timestamp pair) const override {
    const MutexLock lock(room_.mutex);
    return room_.head.actual_from_reported(pair);
  }
  [[nodiscard]] DescribedTools described_tools() const override {
    return described(room().tools, options_.error_model,
                     Random(options_.seed).fork("tool descriptions"));
  }
  [[nodiscard]] const RoomDescription& room() const override { return room_.described(); }
  [[nodiscard]] const StereoCalibration& actual_calibration() const override { return actual_; }
  [[nodiscard]] const SimOptions& options() const override { return options_; }

 private:
  static Vec3 between_cameras(const StereoCalibration& cameras) {
    return 0.5 * (cameras.left_from_rig.inverse().translation() +
                  cameras.right_from_rig.inverse().translation());
  }

  SimOptions options_;
  StereoCalibration actual_;
  mutable SimRoom room_;
  SimCameras cameras_;
  SimHeadTracker head_;
  SimClicker clicker_;
  SimVoice voice_;
  SimWearer wearer_;
  std::vector<std::unique_ptr<SimDepth>> depth_;
};

}  // namespace

Result<std::unique_ptr<SimHeadset>> SimHeadset::open(RoomDescription room,
                                                     const SimOptions& options) {
  if (Status status = options.check(); !status) {
    return status.error();
  }
  if (Status status = check_room(room); !status) {
    return status.error();
  }
  if (options.surgeon && !room.levels.empty()) {
    if (Status status = check_surgery(room); !status) {
      return status.error();
    }
  }
  const StereoCalibration& reported = hololens2_calibration();
  auto actual = perturbed(reported, options.error_model, Random(options.seed).fork("calibration"));
  if (!actual) {
    return actual.error();
  }
  room = with_bones_off_their_models(std::move(room), options.error_model,
                                     Random(options.seed).fork("bones"));
  room = with_flawed_tags(std::move(room), options.error_model,
                          Random(options.seed).fork("tag flaws"));
  return std::unique_ptr<SimHeadset>(std::make_unique<SimulatedHeadset>(
      std::move(room), options, reported, std::move(actual).value()));
}

}  // namespace orthonav::sim
