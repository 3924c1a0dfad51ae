#include "hal/voice/spotted_voice.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include "base/guarded.h"
#include "base/mutex.h"
#include "base/stopwatch.h"
#include "base/wall_clock.h"
#include "hal/voice/resampler.h"

namespace orthonav::voice {

namespace {

constexpr Duration kStallsAfter = std::chrono::milliseconds(400);

/// From a microphone to phrases with times.
class Listener {
 public:
  Listener(std::unique_ptr<Microphone> microphone, std::unique_ptr<CommandSpotter> spotter,
           Resampler resampler)
      : microphone_(std::move(microphone)),
        spotter_(std::move(spotter)),
        resampler_(std::move(resampler)) {}

  /// Reads a block of sound and appends the phrases in it; false if there is no sound yet.
  Result<bool> listen(std::vector<Phrase>& phrases) {
    std::array<std::int16_t, 4096> block;
    const auto count = microphone_->read(block);
    if (!count) {
      return count.error();
    }
    if (*count == 0) {
      return false;
    }
    sound_.clear();
    if (const Status s = resampler_.push(std::span(block).first(*count), sound_); !s) {
      return s.error();
    }
    taken_ += static_cast<std::int64_t>(sound_.size());
    commands_.clear();
    spotter_->push(sound_, commands_);
    for (SpokenCommand& command : commands_) {
      phrases.push_back({std::move(command.text), command.confidence, time_of(command.begin)});
    }
    return true;
  }

 private:
  std::unique_ptr<Microphone> microphone_;
  std::unique_ptr<CommandSpotter> spotter_;
  Resampler resampler_;
  std::vector<std::int16_t> sound_;      // reused
  std::vector<SpokenCommand> commands_;  // reused
  std::int64_t taken_ = 0;
  Timestamp last_ = Timestamp::min();

  /// Counted back from the newest sample, since a microphone's crystal drifts against the headset's
  /// clock.
  Timestamp time_of(std::int64_t sample) {
    const Timestamp newest = microphone_->newest_sample_time().value_or(Timestamp{});
    const Timestamp time =
        newest - from_seconds(static_cast<double>(taken_ - sample) / kSpeechRateHz);
    last_ = std::max(last_, time);
    return last_;
  }
};

/// Passes on the phrases spoken up to the requested time.
Status deliver(std::vector<Phrase>& heard, Timestamp until, std::vector<Phrase>& phrases) {
  const auto due = std::find_if(heard.begin(), heard.end(),
                                [&](const Phrase& phrase) { return phrase.time > until; });
  phrases.insert(phrases.end(), std::make_move_iterator(heard.begin()),
                 std::make_move_iterator(due));
  heard.erase(heard.begin(), due);
  return {};
}

class VoiceInPoll : public Voice {
 public:
  explicit VoiceInPoll(Listener listener) : listener_(std::move(listener)) {}

 private:
  Listener listener_;
  std::vector<Phrase> heard_;

  Status do_poll(Timestamp until, std::vector<Phrase>& phrases) override {
    Result<bool> more = true;
    while (more && *more) {
      more = listener_.listen(heard_);
    }
    return more ? deliver(heard_, until, phrases) : Status(more.error());
  }
};

class VoiceOnItsOwnThread : public Voice {
 public:
  VoiceOnItsOwnThread(Listener listener, std::unique_ptr<const Clock> wall)
      : listener_(std::move(listener)), wall_(std::move(wall)) {
    thread_ = std::thread([this] {
      const Status died = guarded("voice", [this] { run(); });
      const MutexLock lock(mutex_);
      died_ = died;
    });
  }
  ~VoiceOnItsOwnThread() override {
    {
      const MutexLock lock(mutex_);
      stop_ = true;
    }
    wake_.notify_one();
    thread_.join();
  }
  VoiceOnItsOwnThread(const VoiceOnItsOwnThread&) = delete;
  VoiceOnItsOwnThread& operator=(const VoiceOnItsOwnThread&) = delete;

 private:
  Listener listener_;
  Mutex mutex_;
  ConditionVariable wake_;
  bool stop_ ORTHONAV_GUARDED_BY(mutex_) = false;
  std::vector<Phrase> heard_ ORTHONAV_GUARDED_BY(mutex_);
  Status trouble_ ORTHONAV_GUARDED_BY(mutex_);
  Status died_ ORTHONAV_GUARDED_BY(mutex_);
  std::atomic<std::uint64_t> blocks_ = 0;  ///< processed by its thread, including empty ones
  // Used by the polling thread only.
  std::unique_ptr<const Clock> wall_;
  std::uint64_t seen_blocks_ = 0;
  std::optional<Timestamp> alive_at_;
  std::thread thread_;  // last: it uses all of the above

  void run() {
    constexpr auto kBetweenReads = std::chrono::milliseconds(10);
    std::vector<Phrase> phrases;
    for (;;) {
      phrases.clear();
      Result<bool> more = true;
      while (more && *more) {
        more = listener_.listen(phrases);
        ++blocks_;
      }
      const MutexLock lock(mutex_);
      heard_.insert(heard_.end(), phrases.begin(), phrases.end());
      if (!more) {
        trouble_ = more.error();
      }
      const Stopwatch since_read;
      while (!stop_ && wake_.wait_until(mutex_, since_read.after(kBetweenReads))) {
      }
      if (stop_) {
        return;
      }
    }
  }
  /// Whether its thread has done nothing for `kStallsAfter`: the microphone or the recognizer
  /// hangs.
  bool stalled() {
    const Timestamp now = wall_->now();
    const std::uint64_t blocks = blocks_;
    if (blocks != seen_blocks_ || !alive_at_) {
      seen_blocks_ = blocks;
      alive_at_ = now;
    }
    return now - *alive_at_ > kStallsAfter;
  }
  Status do_poll(Timestamp until, std::vector<Phrase>& phrases) override {
    const MutexLock lock(mutex_);
    if (!died_) {
      return died_;
    }
    if (stalled()) {
      return Error{"voice: has listened to nothing for 0.4 s", ErrorCode::kUnavailable};
    }
    if (const Status trouble = std::exchange(trouble_, Status()); !trouble) {
      return trouble;
    }
    return deliver(heard_, until, phrases);
  }
};

}  // namespace

Result<std::unique_ptr<Voice>> open_spotted_voice(std::unique_ptr<Microphone> microphone,
                                                  const SpotterOptions& options,
                                                  Listening listening,
                                                  std::unique_ptr<const Clock> wall) {
  auto spotter = CommandSpotter::create(options);
  if (!spotter) {
    return spotter.error();
  }
  auto resampler = Resampler::create(microphone->sample_rate_hz(), kSpeechRateHz);
  if (!resampler) {
    return resampler.error();
  }
  Listener listener(std::move(microphone), std::move(*spotter), std::move(*resampler));
  if (listening == Listening::kInPoll) {
    return std::unique_ptr<Voice>(std::make_unique<VoiceInPoll>(std::move(listener)));
  }
  return std::unique_ptr<Voice>(std::make_unique<VoiceOnItsOwnThread>(
      std::move(listener), wall ? std::move(wall) : std::make_unique<WallClock>()));
}

}  // namespace orthonav::voice
