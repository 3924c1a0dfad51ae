#include "hal/replay/recorder.h"

#include <algorithm>
#include <atomic>
#include <optional>
#include <utility>
#include <vector>

#include "base/mutex.h"
#include "hal/replay/layout.h"
#include "hal/replay/recording_writer.h"

namespace orthonav::replay {

namespace {

/// The writer until its first failure, and that failure.
class Tape {
 public:
  explicit Tape(std::unique_ptr<RecordingWriter> writer) : writer_(std::move(writer)) {}

  /// Calls `write` with the writer while recording is on.
  template <class Write>
  void record(const Write& write) {
    if (!running_.load()) {
      return;
    }
    // Another thread may have closed it meanwhile: a late write is not a failure.
    if (Status status = write(*writer_); !status && running_.load()) {
      fail(status);
    }
  }
  [[nodiscard]] Status status() const {
    const MutexLock lock(mutex_);
    return failure_;
  }
  [[nodiscard]] bool failed() const { return failed_.load(); }
  Status close() {
    if (running_.exchange(false)) {
      if (Status status = writer_->close(); !status) {
        fail(status);
      }
    }
    return status();
  }

  std::atomic<std::int64_t> newest_sequence{-1};

 private:
  std::unique_ptr<RecordingWriter> writer_;
  std::atomic<bool> running_{true};
  std::atomic<bool> failed_{false};
  mutable Mutex mutex_;
  Status failure_ ORTHONAV_GUARDED_BY(mutex_);

  void fail(const Status& status) {
    const MutexLock lock(mutex_);
    running_ = false;
    if (failure_.ok()) {
      failure_ = status;
      failed_ = true;
    }
  }
};

class RecordingDepth : public DepthCamera {
 public:
  RecordingDepth(Headset& headset, DepthCamera& inner, Tape& tape)
      : headset_(headset), inner_(inner), tape_(tape) {}
  /// Records all available frames.
  void drain() {
    for (auto answer = next(unseen_); answer && *answer == Next::kFrame;) {
      answer = next(unseen_);
    }
  }

 private:
  Headset& headset_;
  DepthCamera& inner_;
  Tape& tape_;
  DepthFrame unseen_;

  [[nodiscard]] const DepthCalibration& do_calibration() const override {
    return inner_.calibration();
  }
  Result<Next> do_next(DepthFrame& frame) override {
    auto answer = inner_.next(frame);
    if (!answer || *answer != Next::kFrame) {
      return answer;
    }
    tape_.record([&](RecordingWriter& w) {
      return w.depth(inner_.calibration(), frame, headset_.clock().now());
    });
    return answer;
  }
};
using RecordingDepths = std::vector<std::unique_ptr<RecordingDepth>>;

class RecordingCamera : public StereoCamera {
 public:
  /// Drains the given depth cameras at each call.
  RecordingCamera(Headset& inner, Tape& tape, const RecordingDepths& drained)
      : inner_(inner), tape_(tape), drained_(drained) {}

 private:
  Headset& inner_;
  Tape& tape_;
  const RecordingDepths& drained_;

  [[nodiscard]] const StereoCalibration& do_calibration() const override {
    return inner_.cameras().calibration();
  }
  Result<Next> do_next(StereoFrame& frame) override {
    auto answer = inner_.cameras().next(frame);
    if (answer && *answer == Next::kFrame) {
      tape_.record([&](RecordingWriter& w) { return w.frame(frame, inner_.clock().now()); });
      tape_.newest_sequence = frame.sequence;
    }
    for (const auto& depth : drained_) {
      depth->drain();
    }
    return answer;
  }
};

class RecordingHead : public HeadTracker {
 public:
  RecordingHead(Headset& inner, Tape& tape) : inner_(inner), tape_(tape) {}

 private:
  Headset& inner_;
  Tape& tape_;

  [[nodiscard]] Tracked<Transform<World, Rig>> do_world_from_rig(Timestamp at) const override {
    const auto answer = inner_.head().world_from_rig(at);
    tape_.record([&](RecordingWriter& w) { return w.head_answer(tape_.newest_sequence, answer); });
    return answer;
  }
};

/// For both clicker and voice. An event was on time if it came with the first poll that covered its
/// time, and late otherwise: the replay then delivers it equally late.
template <class Device, class Event>
class RecordingEvents : public Device {
 public:
  RecordingEvents(Device& inner, Tape& tape) : inner_(inner), tape_(tape) {}

 private:
  Device& inner_;
  Tape& tape_;
  /// The time of a poll for everything may not fit into a file.
  static constexpr Timestamp kLatest{Duration{kMaxNs}};
  std::optional<Timestamp> asked_until_;
  Timestamp available_ = Timestamp::min();

  Status do_poll(Timestamp until, std::vector<Event>& events) override {
    const std::size_t before = events.size();
    // A failed poll counts too: events due in it come with a later one and are late.
    const Status status = inner_.poll(until, events);
    for (std::size_t i = before; i < events.size(); ++i) {
      const bool late = asked_until_ && events[i].time <= *asked_until_;
      available_ = std::max(available_, late ? std::min(until, kLatest) : events[i].time);
      tape_.record([&](RecordingWriter& w) {
        return w.event(Delivered<Event>{events[i], available_});
      });
    }
    asked_until_ = std::max(asked_until_.value_or(until), until);
    return status;
  }
};

class RecordingDisplay : public Display {
 public:
  explicit RecordingDisplay(Headset& inner) : inner_(inner) {}

 private:
  Headset& inner_;

  [[nodiscard]] Duration do_latency() const override {
    return inner_.display().predicted_display_time(Timestamp{}) - Timestamp{};
  }
  Status do_shown(const ShownFrame& frame) override { return inner_.display().shown(frame); }
};

class Recorder : public RecordingHeadset {
 public:
  Recorder(Headset& inner, std::unique_ptr<Headset> owned, std::unique_ptr<RecordingWriter> writer,
           bool takes_depth)
      : RecordingHeadset(inner),
        owned_(std::move(owned)),
        inner_(inner),
        tape_(std::move(writer)),
        clicker_(inner_.clicker(), tape_),
        voice_(inner_.voice(), tape_) {
    RecordingDepths& depths = takes_depth ? drained_ : passed_on_;
    for (DepthCamera* camera : inner_.depth_cameras()) {
      depths.push_back(std::make_unique<RecordingDepth>(inner_, *camera, tape_));
    }
  }
  ~Recorder() override { static_cast<void>(tape_.close()); }
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  [[nodiscard]] StereoCamera& cameras() override { return cameras_; }
  [[nodiscard]] HeadTracker& head() override { return head_; }
  [[nodiscard]] Clicker& clicker() override { return clicker_; }
  [[nodiscard]] Voice& voice() override { return voice_; }
  [[nodiscard]] Display& display() override { return display_; }
  [[nodiscard]] std::vector<DepthCamera*> depth_cameras() override { return borrowed(passed_on_); }
  [[nodiscard]] Status recording_status() const override { return tape_.status(); }
  [[nodiscard]] bool recording_failed() const override { return tape_.failed(); }
  Status close() override { return tape_.close(); }

 private:
  std::unique_ptr<Headset> owned_;
  Headset& inner_;
  Tape tape_;
  RecordingDepths drained_;
  RecordingDepths passed_on_;
  RecordingCamera cameras_{inner_, tape_, drained_};
  RecordingHead head_{inner_, tape_};
  RecordingEvents<Clicker, ClickerEvent> clicker_;
  RecordingEvents<Voice, Phrase> voice_;
  RecordingDisplay display_{inner_};
};

Result<std::unique_ptr<RecordingHeadset>> make(Headset& inner, std::unique_ptr<Headset> owned,
                                               const std::filesystem::path& folder,
                                               const RecorderOptions& options) {
  if (!inner.cameras().calibration().has_images()) {
    return Error{folder.string() + ": " + inner.name() +
                 " has no cameras, and what is recorded is their images"};
  }
  RecordedDevice device;
  device.epoch_ticks_100ns = inner.epoch_ticks_100ns();
  device.display_latency = inner.display().predicted_display_time(Timestamp{}) - Timestamp{};
  device.clock_start = inner.clock().now();
  auto writer =
      RecordingWriter::create(folder, inner.cameras().calibration(), device, options.tools_json);
  if (!writer) {
    return writer.error();
  }
  return std::unique_ptr<RecordingHeadset>(
      std::make_unique<Recorder>(inner, std::move(owned), std::move(*writer), options.takes_depth));
}

}  // namespace

Result<std::unique_ptr<RecordingHeadset>> RecordingHeadset::create(
    std::unique_ptr<Headset> inner, const std::filesystem::path& folder,
    const RecorderOptions& options) {
  Headset& borrowed = *inner;
  return make(borrowed, std::move(inner), folder, options);
}

Result<std::unique_ptr<RecordingHeadset>> RecordingHeadset::around(
    Headset& inner, const std::filesystem::path& folder, const RecorderOptions& options) {
  return make(inner, nullptr, folder, options);
}

}  // namespace orthonav::replay
