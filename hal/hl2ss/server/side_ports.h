#pragma once

#include <atomic>
#include <optional>
#include <vector>

#include "base/mutex.h"
#include "hal/hl2ss/server/port.h"
#include "hal/hl2ss/standin_message.h"
#include "hal/hl2ss/voice.h"

namespace orthonav::hl2ss {

/// The other ports than the cameras': configuration, microphone, voice, and the side channel to
/// our own client.
class SidePorts {
 public:
  explicit SidePorts(std::int64_t utc_offset_ticks) : utc_offset_ticks_(utc_offset_ticks) {}

  /// A session begins, or our own client joins one.
  void greet(const StandinHello& hello);
  void end();
  /// Sends the events up to a pair. Phrases wait until they are polled.
  void tell(const std::vector<ClickerEvent>& clicks, const std::vector<Phrase>& phrases,
            const StandinUpTo& up_to);
  /// The frames that the client showed since the last call.
  std::vector<WornFrame> take_shown();
  /// Whether the client is done with the pair of this time.
  [[nodiscard]] bool took(Timestamp pair_time) const;
  void wait_for_took();
  /// The frames shown have been passed on: waiting threads may continue.
  void publish_took();

  std::atomic<bool> hears = false;  ///< a client listens to the microphone

 private:
  Result<std::size_t> configure(Bytes said);
  Result<std::size_t> listen(Bytes said);
  Result<std::size_t> recognize(Bytes said);
  Result<std::size_t> hear_client(Bytes said);
  void send_to_client(const StandinMessage& message);
  [[nodiscard]] std::vector<VoiceResult> results() ORTHONAV_EXCLUDES(mutex_);

  std::int64_t utc_offset_ticks_;
  mutable Mutex mutex_;
  ConditionVariable took_changed_;
  std::optional<std::vector<std::string>> vocabulary_ ORTHONAV_GUARDED_BY(mutex_);
  std::vector<Phrase> phrases_ ORTHONAV_GUARDED_BY(mutex_);
  std::vector<WornFrame> shown_ ORTHONAV_GUARDED_BY(mutex_);
  std::optional<StandinHello> hello_ ORTHONAV_GUARDED_BY(mutex_);
  Timestamp heard_took_ ORTHONAV_GUARDED_BY(mutex_) = Timestamp::min();
  Timestamp took_ ORTHONAV_GUARDED_BY(mutex_) = Timestamp::min();

 public:
  Port configuration{{[this](Bytes said) { return configure(said); }}};
  Port microphone{{[this](Bytes said) { return listen(said); }, [] {}, [this] { hears = false; }}};
  Port voice{{[this](Bytes said) { return recognize(said); }, [] {},
              [this] {
                const MutexLock lock(mutex_);
                vocabulary_.reset();
              }}};
  Port standin{{[this](Bytes said) { return hear_client(said); },
                [this] {
                  if (const auto hello = hello_now()) {
                    send_to_client(*hello);
                  }
                }}};

 private:
  [[nodiscard]] std::optional<StandinHello> hello_now() const {
    const MutexLock lock(mutex_);
    return hello_;
  }
};

}  // namespace orthonav::hl2ss
