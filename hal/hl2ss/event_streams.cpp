#include "hal/hl2ss/event_streams.h"

#include <algorithm>

#include "hal/hl2ss/protocol.h"

namespace orthonav::hl2ss {
namespace {

constexpr auto kAskEvery = std::chrono::milliseconds(100);
constexpr std::size_t kMaxHeardSamples = kMicrophoneHz;
constexpr std::size_t kChannels = 2;
/// A phrase spoken longer ago than this is implausible.
constexpr Duration kSpokenWithin = std::chrono::seconds(30);

}  // namespace

SoundStream::SoundStream(ArrivalMeter& meter, HeadsetTime& time)
    : PacketStream("microphone", {kMaxSoundPayload, false}, meter, time) {}

Status SoundStream::take(const Packet& packet, const Stamped& stamped) {
  constexpr std::size_t kFrame = kChannels * sizeof(std::int16_t);
  if (packet.payload.size() % kFrame != 0) {
    return Error{"sound of " + std::to_string(packet.payload.size()) +
                 " bytes, must be a multiple of 4"};
  }
  const std::size_t count = packet.payload.size() / kFrame;
  const MutexLock lock(mutex_);
  for (std::size_t i = 0; i < count; ++i) {
    const int sum = number_at<std::int16_t>(packet.payload, i * kFrame) +
                    number_at<std::int16_t>(packet.payload, i * kFrame + 2);
    samples_.push_back(static_cast<std::int16_t>(sum / 2));
  }
  // The stamp is the first sample's.
  end_ = stamped.time + from_seconds(static_cast<double>(count) / kMicrophoneHz);
  if (samples_.size() <= kMaxHeardSamples) {
    return {};
  }
  samples_.erase(samples_.begin(), samples_.end() - static_cast<std::ptrdiff_t>(kMaxHeardSamples));
  trouble_ = Error{"microphone: not read for a second, sound was dropped"};
  return {};
}

void SoundStream::disconnected() {
  PacketStream::disconnected();
  const MutexLock lock(mutex_);
  trouble_ = Error{"microphone: disconnected", ErrorCode::kLost};
}

Result<std::size_t> SoundStream::do_read(std::span<std::int16_t> samples) {
  const MutexLock lock(mutex_);
  if (trouble_) {
    Error trouble = std::move(*trouble_);
    trouble_.reset();
    return trouble;
  }
  const std::size_t count = std::min(samples.size(), samples_.size());
  const auto end = samples_.begin() + static_cast<std::ptrdiff_t>(count);
  std::copy(samples_.begin(), end, samples.begin());
  samples_.erase(samples_.begin(), end);
  if (count > 0) {
    delivered_ = end_ - from_seconds(static_cast<double>(samples_.size()) / kMicrophoneHz);
  }
  return count;
}

std::optional<Timestamp> SoundStream::do_newest_sample_time() const {
  const MutexLock lock(mutex_);
  return delivered_;
}

std::vector<std::uint8_t> VoiceStream::opening() {
  have_ = 0;
  asked_ = false;
  return vocabulary_;
}

std::span<std::uint8_t> VoiceStream::room() {
  buffer_.resize(4 + kVoiceResultBytes * kMaxVoiceResults);
  return std::span(buffer_).subspan(have_);
}

std::vector<std::uint8_t> VoiceStream::more(HostTime now) {
  if (asked_ || now < asked_at_ + kAskEvery) {
    return {};
  }
  asked_ = true;
  asked_at_ = now;
  return {kPollVoice};
}

Status VoiceStream::received(std::size_t count, HostTime at) {
  have_ += count;
  for (;;) {
    const auto answer = read_voice_answer(Bytes(buffer_).first(have_));
    if (!answer) {
      return answer.error();
    }
    if (!*answer) {
      return {};
    }
    if (asked_) {
      time_.clock.round_trip(std::chrono::duration_cast<Duration>(at - asked_at_));
    }
    for (const VoiceResult& result : (*answer)->results) {
      hear(result, at);
    }
    std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>((*answer)->bytes),
              buffer_.begin() + static_cast<std::ptrdiff_t>(have_), buffer_.begin());
    have_ -= (*answer)->bytes;
    asked_ = false;
  }
}

/// The start of a phrase may be given in stamps or in FILETIME; anything else becomes `at`.
Timestamp VoiceStream::spoken_at(const VoiceResult& result, HostTime at) {
  const Timestamp now = time_.clock.now();
  const auto boot = static_cast<std::uint64_t>(result.start);
  const std::uint64_t from_utc = boot - static_cast<std::uint64_t>(filetime_offset_);
  for (const std::uint64_t ticks : {boot, from_utc}) {
    const auto time = StampReader(time_.stamps).time_of(ticks, at);
    if (time && *time <= now && now - *time <= kSpokenWithin) {
      return *time;
    }
  }
  return now;
}

void VoiceStream::hear(const VoiceResult& result, HostTime at) {
  if (result.index == phrases_.size()) {
    return;  // not a phrase in its vocabulary
  }
  if (result.index > phrases_.size()) {
    return meter_.damaged("voice: phrase " + std::to_string(result.index) + " of " +
                          std::to_string(phrases_.size()));
  }
  const Timestamp time = spoken_at(result, at);
  meter_.counted();
  const std::string& text = phrases_[result.index];
  if (inbox_.put({text, result.confidence_of_phrase(), time})) {
    return;
  }
  // What was said after it has been answered already. It is shown as not sure, so that it is said
  // again, and not acted upon.
  while (!inbox_.put({text, 0.0, inbox_.last_taken().value_or(time)})) {
  }
}

}  // namespace orthonav::hl2ss
