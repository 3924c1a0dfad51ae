#include "hal/replay/replay_headset.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <utility>
#include <vector>

#include "hal/replay/recording.h"
#include "hal/replay/replay_clock.h"
#include "hal/replay/replay_depth.h"

namespace orthonav::replay {

namespace {

class ReplayCamera : public StereoCamera {
 public:
  ReplayCamera(Recording& recording, Progress& progress, const Clock& clock, ReplayPace pace)
      : recording_(recording), progress_(progress), clock_(clock), pace_(pace) {}
  void step() { ++steps_; }

 private:
  Recording& recording_;
  Progress& progress_;
  const Clock& clock_;
  ReplayPace pace_;
  std::atomic<std::int64_t> steps_{0};  ///< requested and not taken yet
  std::size_t next_ = 0;

  [[nodiscard]] const StereoCalibration& do_calibration() const override {
    return recording_.calibration;
  }
  [[nodiscard]] MayRepeat do_may_repeat() const override { return recording_.may_repeat; }
  Result<Next> do_next(StereoFrame& frame) override {
    if (next_ == recording_.pairs.size()) {
      progress_.pairs_over = true;
      return Next::kEnd;
    }
    if (!due()) {
      return Next::kNone;
    }
    const RecordedPair& pair = recording_.pairs[next_++];
    if (Status s = recording_.left.read(pair.left, frame.left); !s) {
      return s.error();
    }
    if (Status s = recording_.right.read(pair.right, frame.right); !s) {
      return s.error();
    }
    frame.sequence = pair.sequence;
    frame.map_epoch = pair.map_epoch;
    frame.time = pair.time;
    frame.world_from_rig = pair.world_from_rig;
    progress_.advance_to(pair.clock);
    progress_.frame_time = pair.time;
    progress_.sequence = pair.sequence;
    return Next::kFrame;
  }
  /// Whether the next pair is due; in real time the newest due pair becomes the next one.
  bool due() {
    if (pace_ == ReplayPace::kFast) {
      return true;
    }
    if (pace_ == ReplayPace::kStepped) {
      if (steps_ == 0) {
        return false;
      }
      --steps_;
      return true;
    }
    const std::vector<RecordedPair>& pairs = recording_.pairs;
    const Timestamp now = clock_.now();
    if (pairs[next_].clock > now) {
      return false;
    }
    while (next_ + 1 < pairs.size() && pairs[next_ + 1].clock <= now) {
      ++next_;
    }
    return true;
  }
};

class ReplayHead : public HeadTracker {
 public:
  ReplayHead(const Recording& recording, const Progress& progress)
      : recording_(recording), progress_(progress) {}

 private:
  const Recording& recording_;
  const Progress& progress_;

  [[nodiscard]] Tracked<Transform<World, Rig>> do_world_from_rig(Timestamp at) const override {
    const Timestamp known_until = progress_.frame_time.load();
    const auto answered = recording_.head_answers.find(progress_.sequence.load(), at);
    // A device that did not notice a jump answered for the time before it too.
    const bool is_of_older_map =
        std::any_of(recording_.jumps.begin(), recording_.jumps.end(),
                    [&](Timestamp jump) { return at < jump && jump <= known_until; });
    return answered && !is_of_older_map ? *answered : recording_.head.at(at, known_until);
  }
};

/// Delivers each event once it was available to the recorded session too.
template <class Event>
class Deliverer {
 public:
  explicit Deliverer(const std::vector<Delivered<Event>>& events) : events_(events) {}
  void deliver(Timestamp until, std::vector<Event>& out) {
    while (next_ < events_.size() && events_[next_].available <= until) {
      out.push_back(events_[next_++].event);
    }
  }

 private:
  const std::vector<Delivered<Event>>& events_;
  std::size_t next_ = 0;
};

class ReplayClicker : public Clicker {
 public:
  explicit ReplayClicker(const Recording& recording) : deliverer_(recording.events.clicker) {}

 private:
  Deliverer<ClickerEvent> deliverer_;

  Status do_poll(Timestamp until, std::vector<ClickerEvent>& events) override {
    deliverer_.deliver(until, events);
    return {};
  }
};

class ReplayVoice : public Voice {
 public:
  explicit ReplayVoice(const Recording& recording) : deliverer_(recording.events.voice) {}

 private:
  Deliverer<Phrase> deliverer_;

  Status do_poll(Timestamp until, std::vector<Phrase>& phrases) override {
    deliverer_.deliver(until, phrases);
    return {};
  }
};

class Replay : public ReplayHeadset {
 public:
  Replay(std::string name, Recording recording, const ReplayOptions& options)
      : name_(std::move(name)),
        recording_(std::move(recording)),
        clock_(progress_, options, recording_.clock_start),
        cameras_(recording_, progress_, clock_, options.pace) {
    progress_.clock = recording_.clock_start;
    for (RecordedDepth& depth : recording_.depth) {
      depth_.push_back(std::make_unique<ReplayDepth>(depth, progress_, clock_, options.pace));
    }
  }
  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] const Clock& clock() const override { return clock_; }
  [[nodiscard]] std::int64_t epoch_ticks_100ns() const override {
    return recording_.epoch_ticks_100ns;
  }
  [[nodiscard]] StereoCamera* cameras() override { return &cameras_; }
  [[nodiscard]] HeadTracker& head() override { return head_; }
  [[nodiscard]] Clicker& clicker() override { return clicker_; }
  [[nodiscard]] Voice& voice() override { return voice_; }
  [[nodiscard]] Duration display_latency() const override { return recording_.display_latency; }
  [[nodiscard]] std::vector<DepthCamera*> depth_cameras() override { return borrowed(depth_); }
  void step() override { cameras_.step(); }
  [[nodiscard]] const RecordingSummary& summary() const override { return recording_.summary; }
  [[nodiscard]] DescribedTools described_tools() const override {
    if (recording_.tools_json.empty()) {
      return {};
    }
    return ToolsFile{"tools.json of the recording", recording_.tools_json};
  }

 private:
  std::string name_;
  Recording recording_;
  Progress progress_;
  ReplayClock clock_;
  ReplayCamera cameras_;
  ReplayHead head_{recording_, progress_};
  ReplayClicker clicker_{recording_};
  ReplayVoice voice_{recording_};
  std::vector<std::unique_ptr<ReplayDepth>> depth_;
};

constexpr const char* kKeys = "known are pace=fast|realtime|step and stamps=recorder|exact";

Status apply_key(std::string_view item, ReplayOptions& options) {
  if (item == "pace=realtime") {
    options.pace = ReplayPace::kRealtime;
  } else if (item == "pace=step") {
    options.pace = ReplayPace::kStepped;
  } else if (item == "stamps=exact") {
    options.stamps = RecordedStamps::kExact;
  } else if (item.starts_with("pace") && item != "pace=fast") {
    return Error{"pace is unknown; known are fast, realtime and step"};
  } else if (item != "pace=fast" && item != "stamps=recorder") {
    return Error{"\"" + std::string(item) + "\" is unknown; " + kKeys};
  }
  return {};
}

/// Folder and options of "PATH?pace=...&stamps=...".
Result<std::pair<std::string, ReplayOptions>> options_of(const std::string& rest) {
  // A folder's name may hold a question mark.
  std::size_t question = rest.rfind('?');
  if (question != std::string::npos && rest.compare(question, 5, "?pace") != 0 &&
      rest.compare(question, 7, "?stamps") != 0) {
    question = std::string::npos;
  }
  const std::string folder = rest.substr(0, question);
  if (folder.empty()) {
    return Error{"names no folder after replay:"};
  }
  ReplayOptions options;
  if (question == std::string::npos) {
    return std::pair(folder, options);
  }
  std::string_view items = std::string_view(rest).substr(question + 1);
  while (!items.empty()) {
    const std::size_t end = items.find('&');
    if (Status status = apply_key(items.substr(0, end), options); !status) {
      return status.error();
    }
    items = end == std::string_view::npos ? std::string_view{} : items.substr(end + 1);
  }
  return std::pair(folder, options);
}

}  // namespace

std::string cut_warning(const RecordingSummary& summary) {
  if (summary.cut.empty()) {
    return {};
  }
  return "the recording was cut off and is read to its last whole pair, " +
         std::to_string(summary.pairs) + " in all (" + summary.cut +
         "); orthonav recording repair closes it";
}

Result<std::unique_ptr<ReplayHeadset>> ReplayHeadset::open(const std::filesystem::path& folder,
                                                           const ReplayOptions& options) {
  auto recording = read_recording(folder, options.stamps);
  if (!recording) {
    return recording.error();
  }
  return std::unique_ptr<ReplayHeadset>(
      std::make_unique<Replay>("replay:" + folder.string(), std::move(*recording), options));
}

HeadsetScheme scheme() {
  const auto check = [](const std::string& rest) {
    const auto options = options_of(rest);
    return options ? Status{} : Status(options.error());
  };
  const auto open = [](const std::string& rest,
                       const std::vector<std::string>& /*phrases*/) -> Result<OpenedDevice> {
    const auto options = options_of(rest);
    if (!options) {
      return options.error();
    }
    auto opened = ReplayHeadset::open(options->first, options->second);
    if (!opened) {
      return opened.error();
    }
    std::string warning = cut_warning((*opened)->summary());
    return OpenedDevice{std::move(*opened), std::move(warning)};
  };
  return {"replay", "replay:PATH", check, open};
}

}  // namespace orthonav::replay
