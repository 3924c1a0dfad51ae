#pragma once

#include <deque>
#include <optional>

#include "base/mutex.h"
#include "hal/hl2ss/inbox.h"
#include "hal/hl2ss/packet_stream.h"
#include "hal/hl2ss/standin_message.h"

namespace orthonav::hl2ss {

/// The client's end of the side channel to our own server. Thread-safe except for the functions of
/// Protocol.
class StandinStream final : public Protocol {
 public:
  StandinStream(HeadsetTime& time, Inbox<ClickerEvent>& inbox, const net::WakeUp& wake_up)
      : time_(time), inbox_(inbox), wake_up_(wake_up) {}
  [[nodiscard]] std::vector<std::uint8_t> opening() override { return {}; }
  std::span<std::uint8_t> room() override;
  Status received(std::size_t count, HostTime at) override;
  [[nodiscard]] std::vector<std::uint8_t> more(HostTime now) override;
  void disconnected() override;

  void send(const StandinMessage& message);
  /// Whether a pair of this time may be handed out: the server has sent all events up to it. If so,
  /// the clock of a paced server is set to it.
  bool admits(Timestamp pair_time);
  /// Whether it sends a pair only when the client is done with the last one, which may compute for
  /// as long as it likes: none is passed over.
  [[nodiscard]] bool is_paced() const;
  /// Whether there are no more pairs.
  [[nodiscard]] bool has_ended() const;
  [[nodiscard]] std::optional<Duration> display_latency() const;
  /// What may repeat at the headset that the server stands in for; as said last.
  [[nodiscard]] MayRepeat may_repeat() const;

 private:
  Status take(const StandinMessage& message);

  HeadsetTime& time_;
  Inbox<ClickerEvent>& inbox_;
  const net::WakeUp& wake_up_;
  // Used by the protocol only:
  std::vector<std::uint8_t> buffer_;
  std::size_t have_ = 0;

  mutable Mutex mutex_;
  std::vector<std::uint8_t> unsent_ ORTHONAV_GUARDED_BY(mutex_);
  /// Present while connected.
  std::optional<StandinHello> hello_ ORTHONAV_GUARDED_BY(mutex_);
  /// For pairs not handed out yet.
  std::deque<StandinUpTo> up_to_ ORTHONAV_GUARDED_BY(mutex_);
  bool ended_ ORTHONAV_GUARDED_BY(mutex_) = false;
  MayRepeat may_repeat_ ORTHONAV_GUARDED_BY(mutex_);
};

}  // namespace orthonav::hl2ss
