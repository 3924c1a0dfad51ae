#include "hal/sim/sim_headset.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <utility>

#include "base/mutex.h"
#include "hal/sim/head_track.h"
#include "hal/sim/hololens2.h"
#include "hal/sim/imperfect.h"
#include "hal/sim/room_simulation.h"
#include "hal/sim/stereo_renderer.h"

namespace orthonav::sim {
namespace {

/// From mid-exposure to the images in memory, in addition to half the exposure.
constexpr Duration kReadout = std::chrono::milliseconds(5);
/// From submitting a frame to its light: one refresh at 60 Hz.
constexpr Duration kDisplayLatency = std::chrono::milliseconds(16);
constexpr Duration kAfterDone = std::chrono::milliseconds(500);
/// The device had been running for a while.
constexpr Timestamp kStart{std::chrono::seconds(100)};

class SimClock final : public Clock {
 public:
  explicit SimClock(Pace pace) : pace_(pace), opened_(std::chrono::steady_clock::now()) {}
  [[nodiscard]] Timestamp now() const override {
    if (pace_ == Pace::kRealtime) {
      return kStart +
             std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now() - opened_);
    }
    return Timestamp(Duration(now_ns_.load()));
  }
  void set(Timestamp now) { now_ns_.store(now.time_since_epoch().count()); }

 private:
  Pace pace_;
  std::chrono::steady_clock::time_point opened_;
  std::atomic<std::int64_t> now_ns_{kStart.time_since_epoch().count()};
};

/// What every part of the headset shares.
struct Shared {
  Mutex mutex;
  SimClock clock;
  RoomSimulation simulation ORTHONAV_GUARDED_BY(mutex);
  HeadTrack head ORTHONAV_GUARDED_BY(mutex);
  Timestamp last_frame ORTHONAV_GUARDED_BY(mutex) = kStart;

  Shared(RoomDescription room, const SimOptions& options, Vec3 eyes_in_rig)
      : clock(options.pace),
        simulation(std::move(room), options, eyes_in_rig, kStart),
        head(Random(options.seed).fork("head tracker"), options.error_model) {}
};

class SimCameras final : public StereoCamera {
 public:
  SimCameras(Shared& shared, const SimOptions& options, StereoCalibration reported,
             StereoCalibration actual)
      : shared_(shared),
        options_(options),
        half_exposure_(from_seconds(0.5 * options.error_model.exposure_s)),
        reported_(std::move(reported)),
        states_(options.error_model.exposure_s > 0.0 ? 3 : 1) {
    if (options.render) {
      renderer_ = std::make_unique<StereoRenderer>(shared.simulation.room(), options.error_model,
                                                   std::move(actual), options.seed);
    }
  }

 private:
  [[nodiscard]] const StereoCalibration& do_calibration() const override { return reported_; }

  /// Frames are due at whole ticks of 100 ns, so that files keep their times.
  [[nodiscard]] Timestamp time_of(std::int64_t number) const {
    return kStart +
           Duration(100 * static_cast<std::int64_t>(std::floor(
                              static_cast<double>(number) * 1e7 / options_.frame_rate_hz + 0.5)));
  }
  [[nodiscard]] Timestamp delivery_of(std::int64_t number) const {
    return time_of(number) + half_exposure_ + kReadout;
  }

  Result<Next> do_next(StereoFrame& frame) override {
    if (options_.pace == Pace::kRealtime) {
      const Timestamp now = shared_.clock.now();
      if (delivery_of(number_) > now) {
        return Next::kNone;
      }
      // A caller who comes late misses frames, as with a real camera.
      while (delivery_of(number_ + 1) <= now) {
        ++number_;
      }
    }
    const Timestamp time = time_of(number_);
    {
      const MutexLock lock(shared_.mutex);
      const auto finished = shared_.simulation.finished_at();
      if (seconds(time - kStart) > options_.limit_s ||
          (finished && time > *finished + kAfterDone)) {
        return Next::kEnd;
      }
      expose(time, frame);
    }
    render(frame);
    shared_.clock.set(delivery_of(number_));
    ++number_;
    return Next::kFrame;
  }

  void expose(Timestamp time, StereoFrame& frame) ORTHONAV_REQUIRES(shared_.mutex) {
    RoomSimulation& simulation = shared_.simulation;
    simulation.advance(time + half_exposure_);
    const auto middle = static_cast<std::int64_t>(states_.size() / 2);
    for (std::size_t i = 0; i < states_.size(); ++i) {
      simulation.state_at(time + (static_cast<std::int64_t>(i) - middle) * half_exposure_,
                          states_[i]);
    }
    const Timestamp before = time - RoomSimulation::kStep;
    shared_.head.add(number_, time, simulation.world_from_rig(time), before,
                     simulation.world_from_rig(before));
    shared_.last_frame = time;
    frame.sequence = number_;
    frame.time = time;
    frame.world_from_rig = shared_.head.at(time).value;
  }

  void render(StereoFrame& frame) {
    if (renderer_) {
      return renderer_->render(states_, number_, frame);
    }
    resize(frame.left, reported_.left);
    resize(frame.right, reported_.right);
  }

  static void resize(GreyImage& image, const CameraModel& camera) {
    image.width_px = camera.width_px();
    image.height_px = camera.height_px();
    image.pixels.resize(static_cast<std::size_t>(image.width_px) *
                        static_cast<std::size_t>(image.height_px));
  }

  Shared& shared_;
  SimOptions options_;
  Duration half_exposure_;
  StereoCalibration reported_;
  std::vector<RoomState> states_;  ///< over the exposure
  std::unique_ptr<StereoRenderer> renderer_;
  std::int64_t number_ = 1;  ///< of the next frame
};

class SimHeadTracker final : public HeadTracker {
 public:
  explicit SimHeadTracker(Shared& shared) : shared_(shared) {}

 private:
  [[nodiscard]] Tracked<Transform<World, Rig>> do_world_from_rig(Timestamp at) const override {
    const MutexLock lock(shared_.mutex);
    return shared_.head.at(at);
  }
  [[nodiscard]] std::optional<Timestamp> do_newest_measurement() const override {
    const MutexLock lock(shared_.mutex);
    return shared_.head.newest();
  }
  Shared& shared_;
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
  explicit SimClicker(Shared& shared) : shared_(shared) {}

 private:
  Status do_poll(Timestamp until, std::vector<ClickerEvent>& events) override {
    const MutexLock lock(shared_.mutex);
    hand_over(shared_.simulation.clicks(), until, events);
    return {};
  }
  Shared& shared_;
};

class SimVoice final : public Voice {
 public:
  explicit SimVoice(Shared& shared) : shared_(shared) {}

 private:
  Status do_poll(Timestamp until, std::vector<Phrase>& phrases) override {
    const MutexLock lock(shared_.mutex);
    hand_over(shared_.simulation.phrases(), until, phrases);
    return {};
  }
  Shared& shared_;
};

class SimDisplay final : public Display {
 public:
  explicit SimDisplay(Shared& shared) : shared_(shared) {}

 private:
  [[nodiscard]] Duration do_latency() const override { return kDisplayLatency; }
  Status do_shown(const ShownFrame& frame) override {
    const MutexLock lock(shared_.mutex);
    // The display draws for the pose that it predicted when the frame was submitted.
    const auto believed = shared_.head.at(frame.display_time, frame.display_time - kDisplayLatency);
    if (believed.status == PoseStatus::kLost) {
      return {};
    }
    shared_.simulation.eyes().show(frame, believed.value);
    return {};
  }
  Shared& shared_;
};

class SimulatedHeadset final : public SimHeadset {
 public:
  SimulatedHeadset(RoomDescription room, const SimOptions& options, StereoCalibration reported,
                   StereoCalibration actual)
      : options_(options),
        shared_(std::move(room), options, between_cameras(reported)),
        cameras_(shared_, options, std::move(reported), std::move(actual)),
        head_(shared_),
        clicker_(shared_),
        voice_(shared_),
        display_(shared_) {}

  [[nodiscard]] std::string name() const override { return "simulated operating room"; }
  [[nodiscard]] const Clock& clock() const override { return shared_.clock; }
  [[nodiscard]] StereoCamera& cameras() override { return cameras_; }
  [[nodiscard]] HeadTracker& head() override { return head_; }
  [[nodiscard]] Clicker& clicker() override { return clicker_; }
  [[nodiscard]] Voice& voice() override { return voice_; }
  [[nodiscard]] Display& display() override { return display_; }

  // Only the thread that takes the pairs adds to the truth, and only that thread asks for it.
  [[nodiscard]] const Truth& truth() const override ORTHONAV_NO_THREAD_SAFETY_ANALYSIS {
    return shared_.simulation.truth();
  }
  [[nodiscard]] RoomState state() const override {
    const MutexLock lock(shared_.mutex);
    RoomState state;
    shared_.simulation.state_at(shared_.last_frame, state);
    return state;
  }
  [[nodiscard]] Transform<World, Room> world_from_room() const override {
    const MutexLock lock(shared_.mutex);
    return shared_.simulation.world_from_room(shared_.last_frame);
  }
  [[nodiscard]] DescribedTools described_tools() const override {
    return described(room().tools, options_.error_model,
                     Random(options_.seed).fork("tool descriptions"));
  }
  // The same from the first moment on.
  [[nodiscard]] const RoomDescription& room() const override ORTHONAV_NO_THREAD_SAFETY_ANALYSIS {
    return shared_.simulation.room();
  }
  [[nodiscard]] const SimOptions& options() const override { return options_; }

 private:
  static Vec3 between_cameras(const StereoCalibration& cameras) {
    return 0.5 * (cameras.left_from_rig.inverse().translation() +
                  cameras.right_from_rig.inverse().translation());
  }

  SimOptions options_;
  mutable Shared shared_;
  SimCameras cameras_;
  SimHeadTracker head_;
  SimClicker clicker_;
  SimVoice voice_;
  SimDisplay display_;
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
  const StereoCalibration reported = hololens2_calibration();
  auto actual = perturbed(reported, options.error_model, Random(options.seed).fork("calibration"));
  if (!actual) {
    return actual.error();
  }
  return std::unique_ptr<SimHeadset>(std::make_unique<SimulatedHeadset>(
      std::move(room), options, reported, std::move(actual).value()));
}

}  // namespace orthonav::sim
