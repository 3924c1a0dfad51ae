#include "hal/replay/recorder.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <deque>
#include <optional>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "base/guarded.h"
#include "base/mutex.h"
#include "base/stopwatch.h"
#include "hal/replay/layout.h"
#include "hal/replay/recording_writer.h"

namespace orthonav::replay {

namespace {

/// Four seconds of pairs and depth. Lines, which are small, may add a sixth.
constexpr std::size_t kMostBytes = std::size_t{96} << 20U;
constexpr std::size_t kMaxBytesWithLines = std::size_t{112} << 20U;
/// As long as a pair may wait for the disk where time goes on meanwhile.
constexpr auto kMaxWait = std::chrono::milliseconds(1);

struct PairToWrite {
  StereoFrame frame;
  Timestamp clock{};
};
struct DepthToWrite {
  const DepthCalibration* calibration = nullptr;
  DepthFrame frame;
  Timestamp clock{};
};
struct AnswerToWrite {
  std::int64_t sequence = 0;
  Tracked<Transform<World, Rig>> answer;
};
using ToWrite = std::variant<PairToWrite, DepthToWrite, AnswerToWrite, Delivered<ClickerEvent>,
                             Delivered<Phrase>>;

std::size_t bytes_of(const ToWrite& what) {
  if (const auto* pair = std::get_if<PairToWrite>(&what)) {
    return pair->frame.left.pixels.size() + pair->frame.right.pixels.size();
  }
  if (const auto* depth = std::get_if<DepthToWrite>(&what)) {
    return 2 * (depth->frame.range_mm.pixels.size() + depth->frame.brightness.pixels.size());
  }
  return sizeof(ToWrite);
}

/// The writer until its first failure, and that failure; what is to be written, and the thread that
/// writes it.
class RecordingSink {
 public:
  RecordingSink(std::unique_ptr<RecordingWriter> writer, const Clock& clock)
      : clock_(clock), writer_(std::move(writer)), thread_([this] { work(); }) {}
  ~RecordingSink() { static_cast<void>(close()); }
  RecordingSink(const RecordingSink&) = delete;
  RecordingSink& operator=(const RecordingSink&) = delete;

  /// Never waits.
  void pair(const StereoFrame& frame) {
    PairToWrite what{{}, clock_.now()};
    const std::size_t bytes = frame.left.pixels.size() + frame.right.pixels.size();
    {
      const MutexLock lock(mutex_);
      if (!running_) {
        return;
      }
      ++counts_.pairs;
      if (bytes_ + bytes > kMostBytes) {
        ++counts_.lost_pairs;
        return;
      }
      bytes_ += bytes;
      if (!spare_.empty()) {  // its buffers are used again
        what.frame = std::move(spare_.back());
        spare_.pop_back();
      }
    }
    what.frame = frame;
    const MutexLock lock(mutex_);
    add(std::move(what));
  }
  void depth(const DepthCalibration& calibration, const DepthFrame& frame) {
    DepthToWrite what{&calibration, frame, clock_.now()};
    const MutexLock lock(mutex_);
    add_within(kMostBytes, std::move(what));
  }
  /// An event, or an answer of the head tracker.
  template <class Line>
  void line(Line what) {
    const MutexLock lock(mutex_);
    add_within(kMaxBytesWithLines, std::move(what));
  }
  /// Waits until everything so far is written: for a millisecond, and for as long as the device's
  /// time stands still.
  void settle() {
    const MutexLock lock(mutex_);
    const std::int64_t last = added_;
    for (bool goes_on = false; running_ && written_ < last && !goes_on;) {
      const Timestamp before = clock_.now();
      changed_.wait_until(mutex_, Stopwatch().after(kMaxWait));
      goes_on = clock_.now() != before;
    }
  }

  [[nodiscard]] Status status() const {
    const MutexLock lock(mutex_);
    return failure_;
  }
  [[nodiscard]] bool failed() const { return failed_.load(); }
  [[nodiscard]] RecordedCounts counts() const {
    const MutexLock lock(mutex_);
    return counts_;
  }
  void stop() {
    const MutexLock lock(mutex_);
    running_ = false;
  }
  Status close() {
    {
      const MutexLock lock(mutex_);
      running_ = false;
      closing_ = true;
      changed_.notify_all();
    }
    if (thread_.joinable()) {
      thread_.join();
      if (!failed_.load()) {
        note(guarded("recorder", [this] { return writer_->close(); }));
      }
    }
    return status();
  }

  std::atomic<std::int64_t> newest_sequence{-1};

 private:
  void add(ToWrite what) ORTHONAV_REQUIRES(mutex_) {
    waiting_.push_back(std::move(what));
    ++added_;
    changed_.notify_all();
  }
  void add_within(std::size_t most_bytes, ToWrite what) ORTHONAV_REQUIRES(mutex_) {
    if (!running_) {
      return;
    }
    if (bytes_ + bytes_of(what) > most_bytes) {
      ++counts_.lost_others;
      return;
    }
    bytes_ += bytes_of(what);
    add(std::move(what));
  }
  void work() {
    while (std::optional<ToWrite> what = next()) {
      note(guarded("recorder", [&] {
        return std::visit([this](const auto& each) { return write(each); }, *what);
      }));
      const MutexLock lock(mutex_);
      bytes_ -= bytes_of(*what);
      if (auto* pair = std::get_if<PairToWrite>(&*what)) {
        spare_.push_back(std::move(pair->frame));
      }
      ++written_;
      changed_.notify_all();
    }
  }
  /// Waits for it; absent at the end.
  std::optional<ToWrite> next() {
    const MutexLock lock(mutex_);
    while (waiting_.empty() && !closing_ && !failed_.load()) {
      changed_.wait(mutex_);
    }
    if (waiting_.empty() || failed_.load()) {
      return std::nullopt;
    }
    ToWrite what = std::move(waiting_.front());
    waiting_.pop_front();
    return what;
  }
  Status write(const PairToWrite& pair) { return writer_->frame(pair.frame, pair.clock); }
  Status write(const DepthToWrite& depth) {
    return writer_->depth(*depth.calibration, depth.frame, depth.clock);
  }
  Status write(const AnswerToWrite& answer) {
    return writer_->head_answer(answer.sequence, answer.answer);
  }
  template <class Event>
  Status write(const Delivered<Event>& event) {
    return writer_->event(event);
  }
  void note(const Status& done) {
    const MutexLock lock(mutex_);
    if (!done && failure_.ok()) {
      running_ = false;
      failure_ = done;
      failed_ = true;
    }
  }

  const Clock& clock_;
  std::unique_ptr<RecordingWriter> writer_;  ///< of the thread, while there is one
  std::atomic<bool> failed_{false};
  mutable Mutex mutex_;
  ConditionVariable changed_;
  std::deque<ToWrite> waiting_ ORTHONAV_GUARDED_BY(mutex_);
  std::vector<StereoFrame> spare_ ORTHONAV_GUARDED_BY(mutex_);
  std::size_t bytes_ ORTHONAV_GUARDED_BY(mutex_) = 0;  ///< that wait or are being written
  std::int64_t added_ ORTHONAV_GUARDED_BY(mutex_) = 0;
  std::int64_t written_ ORTHONAV_GUARDED_BY(mutex_) = 0;
  bool running_ ORTHONAV_GUARDED_BY(mutex_) = true;
  bool closing_ ORTHONAV_GUARDED_BY(mutex_) = false;
  RecordedCounts counts_ ORTHONAV_GUARDED_BY(mutex_);
  Status failure_ ORTHONAV_GUARDED_BY(mutex_);
  std::thread thread_;
};

class RecordingDepth : public DepthCamera {
 public:
  RecordingDepth(DepthCamera& inner, RecordingSink& tape) : inner_(inner), tape_(tape) {}
  /// Records all available frames.
  void drain() {
    for (auto answer = next(unseen_); answer && *answer == Next::kFrame;) {
      answer = next(unseen_);
    }
  }

 private:
  DepthCamera& inner_;
  RecordingSink& tape_;
  DepthFrame unseen_;

  [[nodiscard]] const DepthCalibration& do_calibration() const override {
    return inner_.calibration();
  }
  Result<Next> do_next(DepthFrame& frame) override {
    auto answer = inner_.next(frame);
    if (!answer || *answer != Next::kFrame) {
      return answer;
    }
    tape_.depth(inner_.calibration(), frame);
    return answer;
  }
};
using RecordingDepths = std::vector<std::unique_ptr<RecordingDepth>>;

class RecordingCamera : public ForwardingCamera, private PairTap {
 public:
  /// Drains the given depth cameras at each call.
  RecordingCamera(StereoCamera& inner, RecordingSink& tape, const RecordingDepths& drained)
      : ForwardingCamera(inner), tape_(tape), drained_(drained), tapped_(inner.tap(this)) {}
  ~RecordingCamera() override { untap(); }
  RecordingCamera(const RecordingCamera&) = delete;
  RecordingCamera& operator=(const RecordingCamera&) = delete;
  /// Records nothing that comes after this.
  void untap() { ForwardingCamera::do_tap(nullptr); }

 private:
  RecordingSink& tape_;
  const RecordingDepths& drained_;
  FrameOrder order_;
  bool tapped_;

  /// The one tap that there is is its own.
  bool do_tap(PairTap* /*tap*/) override { return false; }
  Result<Next> do_next(StereoFrame& frame) override {
    auto answer = ForwardingCamera::do_next(frame);
    const bool came = answer && *answer == Next::kFrame;
    if (came && !tapped_) {
      tape_.pair(frame);
    }
    for (const auto& depth : drained_) {
      depth->drain();
    }
    if (came) {
      tape_.newest_sequence = frame.sequence;
      if (!tapped_) {
        tape_.settle();
      }
    }
    return answer;
  }
  /// Records what `next` would return: a pair that breaks the contract would make the recording
  /// unreadable.
  void received(const StereoFrame& pair) override {
    const StereoCalibration& cameras = do_calibration();
    const auto check = [&]() -> Status {
      const auto fits = [](const char* which, const GreyImage& image, const CameraModel& camera) {
        return check_size("camera pair", which, image, camera.width_px(), camera.height_px());
      };
      const Status left = fits("left", pair.left, cameras.left);
      return left ? fits("right", pair.right, cameras.right) : left;
    };
    if (order_.check("camera pair", pair, check)) {
      tape_.pair(pair);
    }
  }
};

class RecordingHead : public HeadTracker {
 public:
  RecordingHead(Headset& inner, RecordingSink& tape) : inner_(inner), tape_(tape) {}

 private:
  Headset& inner_;
  RecordingSink& tape_;

  [[nodiscard]] Tracked<Transform<World, Rig>> do_world_from_rig(Timestamp at) const override {
    const auto answer = inner_.head().world_from_rig(at);
    tape_.line(AnswerToWrite{tape_.newest_sequence, answer});
    return answer;
  }
};

/// For both clicker and voice. An event was on time if it came with the first poll that covered its
/// time, and late otherwise: the replay then delivers it equally late.
template <class Device, class Event>
class RecordingEvents : public Device {
 public:
  RecordingEvents(Device& inner, RecordingSink& tape) : inner_(inner), tape_(tape) {}

 private:
  Device& inner_;
  RecordingSink& tape_;
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
      tape_.line(Delivered<Event>{events[i], available_});
    }
    asked_until_ = std::max(asked_until_.value_or(until), until);
    return status;
  }
};

class Recorder : public RecordingHeadset {
 public:
  Recorder(Headset& inner, std::unique_ptr<Headset> owned, std::unique_ptr<RecordingWriter> writer,
           bool takes_depth)
      : RecordingHeadset(inner),
        owned_(std::move(owned)),
        inner_(inner),
        tape_(std::move(writer), inner.clock()),
        clicker_(inner_.clicker(), tape_),
        voice_(inner_.voice(), tape_) {
    RecordingDepths& depths = takes_depth ? drained_ : passed_on_;
    for (DepthCamera* camera : inner_.depth_cameras()) {
      depths.push_back(std::make_unique<RecordingDepth>(*camera, tape_));
    }
  }
  ~Recorder() override = default;
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  [[nodiscard]] StereoCamera* cameras() override { return &cameras_; }
  [[nodiscard]] HeadTracker& head() override { return head_; }
  [[nodiscard]] Clicker& clicker() override { return clicker_; }
  [[nodiscard]] Voice& voice() override { return voice_; }
  [[nodiscard]] std::vector<DepthCamera*> depth_cameras() override { return borrowed(passed_on_); }
  [[nodiscard]] Status recording_status() const override { return tape_.status(); }
  [[nodiscard]] bool recording_failed() const override { return tape_.failed(); }
  [[nodiscard]] RecordedCounts counts() const override { return tape_.counts(); }
  void stop() override {
    cameras_.untap();
    tape_.stop();
  }
  Status close() override {
    cameras_.untap();
    return tape_.close();
  }

 private:
  std::unique_ptr<Headset> owned_;
  Headset& inner_;
  RecordingSink tape_;
  RecordingDepths drained_;
  RecordingDepths passed_on_;
  RecordingCamera cameras_{*inner_.cameras(), tape_, drained_};
  RecordingHead head_{inner_, tape_};
  RecordingEvents<Clicker, ClickerEvent> clicker_;
  RecordingEvents<Voice, Phrase> voice_;
};

Result<std::unique_ptr<RecordingHeadset>> make(Headset& inner, std::unique_ptr<Headset> owned,
                                               const std::filesystem::path& folder,
                                               const RecorderOptions& options) {
  if (inner.cameras() == nullptr || inner.tool_poses() != nullptr) {
    return Error{folder.string() + ": " + inner.name() +
                 (inner.cameras() == nullptr ? " has no cameras" : " measures tools itself") +
                 ", and what is recorded is the images in which tools are found"};
  }
  RecordedDevice device;
  device.epoch_ticks_100ns = inner.epoch_ticks_100ns();
  device.display_latency = inner.display_latency();
  device.clock_start = inner.clock().now();
  device.may_repeat = inner.cameras()->may_repeat();
  auto writer =
      RecordingWriter::create(folder, inner.cameras()->calibration(), device, options.tools_json);
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
