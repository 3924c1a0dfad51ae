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
#include "hal/voice/resampler.h"

namespace orthonav::voice {

namespace {

/// This machine's time, from any moment on.
class WallClock : public Clock {
 public:
  [[nodiscard]] Timestamp now() const override { return Timestamp(since_.elapsed()); }

 private:
  Stopwatch since_;
};

constexpr Duration kStallsAfter = std::chrono::milliseconds(400);

/// From a microphone to phrases with times.
class Listener {
 public:
  Listener(std::unique_ptr<Microphone> microphone, std::unique_ptr<CommandSpotter> spotter,
           Resampler resampler)
      : microphone_(std::move(microphone)),
        spotter_(std::move(spotter)),
        resampler_(std::move(resampler)) {}

  /// Reads all there is and appends the phrases in it; counts in `rounds` how often it came round.
  Status listen(std::vector<Phrase>& phrases, std::atomic<std::uint64_t>& rounds) {
    std::array<std::int16_t, 4096> block;
    for (;;) {
      ++rounds;
      const auto count = microphone_->read(block);
      if (!count) {
        return count.error();
      }
      if (*count == 0) {
        return {};
      }
      sound_.clear();
      if (Status s = resampler_.push(std::span(block).first(*count), sound_); !s) {
        return s;
      }
      taken_ += static_cast<std::int64_t>(sound_.size());
      commands_.clear();
      spotter_->push(sound_, commands_);
      for (SpokenCommand& command : commands_) {
        phrases.push_back({std::move(command.text), command.confidence, time_of(command.begin)});
      }
    }
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

/// Passes on what was spoken before the time asked for.
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
  std::atomic<std::uint64_t> rounds_ = 0;

  Status do_poll(Timestamp until, std::vector<Phrase>& phrases) override {
    if (Status listened = listener_.listen(heard_, rounds_); !listened) {
      return listened;
    }
    return deliver(heard_, until, phrases);
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
  std::atomic<std::uint64_t> rounds_ = 0;
  // Of whoever polls.
  std::unique_ptr<const Clock> wall_;
  std::uint64_t seen_rounds_ = 0;
  std::optional<Timestamp> alive_at_;
  std::thread thread_;  // last: it uses all of the above

  void run() {
    constexpr auto kBetweenReads = std::chrono::milliseconds(10);
    std::vector<Phrase> phrases;
    for (;;) {
      phrases.clear();
      const Status listened = listener_.listen(phrases, rounds_);
      const MutexLock lock(mutex_);
      heard_.insert(heard_.end(), phrases.begin(), phrases.end());
      if (!listened) {
        trouble_ = listened;
      }
      const Stopwatch since_read;
      while (!stop_ && wake_.wait_until(mutex_, since_read.after(kBetweenReads))) {
      }
      if (stop_) {
        return;
      }
    }
  }
  /// Nothing was listened to for so long: the microphone hangs, or the recognizer.
  bool stalled() {
    const Timestamp now = wall_->now();
    const std::uint64_t rounds = rounds_;
    if (rounds != seen_rounds_ || !alive_at_) {
      seen_rounds_ = rounds;
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
