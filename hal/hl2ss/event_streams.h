#pragma once

#include "base/mutex.h"
#include "hal/api/devices.h"
#include "hal/api/microphone.h"
#include "hal/hl2ss/inbox.h"
#include "hal/hl2ss/packet_stream.h"
#include "hal/hl2ss/protocol.h"
#include "hal/hl2ss/voice.h"

namespace orthonav::hl2ss {

/// Sound: the mean of its two channels is kept for at most a second.
class SoundStream final : public PacketStream, public Microphone {
 public:
  SoundStream(ArrivalMeter& meter, HeadsetTime& time);
  [[nodiscard]] std::vector<std::uint8_t> opening() override { return {255, 255}; }
  void disconnected() override;

 private:
  Status take(const Packet& packet, const Stamped& stamped) override;
  [[nodiscard]] int do_sample_rate_hz() const override { return kMicrophoneHz; }
  Result<std::size_t> do_read(std::span<std::int16_t> samples) override;
  [[nodiscard]] std::optional<Timestamp> do_newest_sample_time() const override;

  mutable Mutex mutex_;
  std::deque<std::int16_t> samples_ ORTHONAV_GUARDED_BY(mutex_);
  Timestamp end_ ORTHONAV_GUARDED_BY(mutex_){};  ///< of the newest sample received
  std::optional<Timestamp> delivered_ ORTHONAV_GUARDED_BY(mutex_);
  std::optional<Error> trouble_ ORTHONAV_GUARDED_BY(mutex_);
};

/// The headset's own speech recognition: it is sent the phrases, then polled ten times a second.
class VoiceStream final : public Protocol {
 public:
  /// `filetime_offset` is UTC in ticks of 100 ns minus the headset's stamps.
  VoiceStream(std::vector<std::string> phrases, std::vector<std::uint8_t> vocabulary,
              std::int64_t filetime_offset, ArrivalMeter& meter, HeadsetTime& time,
              Inbox<Phrase>& inbox)
      : phrases_(std::move(phrases)),
        vocabulary_(std::move(vocabulary)),
        filetime_offset_(filetime_offset),
        meter_(meter),
        time_(time),
        inbox_(inbox) {}
  [[nodiscard]] std::vector<std::uint8_t> opening() override;
  std::span<std::uint8_t> room() override;
  Status received(std::size_t count, HostTime at) override;
  [[nodiscard]] std::vector<std::uint8_t> more(HostTime now) override;
  void disconnected() override {}

 private:
  [[nodiscard]] Timestamp spoken_at(const VoiceResult& result, HostTime at);
  void hear(const VoiceResult& result, HostTime at);

  std::vector<std::string> phrases_;
  std::vector<std::uint8_t> vocabulary_;
  std::int64_t filetime_offset_;
  ArrivalMeter& meter_;
  HeadsetTime& time_;
  Inbox<Phrase>& inbox_;
  std::vector<std::uint8_t> buffer_;
  std::size_t have_ = 0;
  bool asked_ = false;
  HostTime asked_at_{};
};

}  // namespace orthonav::hl2ss
