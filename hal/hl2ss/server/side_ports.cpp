#include "hal/hl2ss/server/side_ports.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

#include "hal/hl2ss/protocol.h"

namespace orthonav::hl2ss {
namespace {

constexpr std::array<std::uint16_t, 4> kVersion = {1, 0, 0, 0};
constexpr std::size_t kMostWaiting = 64;

std::uint32_t graded(double confidence) {
  if (confidence >= 0.75) {
    return 0;
  }
  if (confidence >= 0.5) {
    return 1;
  }
  return confidence > 0.0 ? 2 : 3;
}

}  // namespace

Result<std::size_t> SidePorts::configure(Bytes said) {
  std::vector<std::uint8_t> answer;
  if (said[0] == 0) {
    for (const std::uint16_t number : kVersion) {
      append(answer, number);
    }
  } else if (said[0] == 1) {
    append(answer, static_cast<std::uint64_t>(utc_offset_ticks_));
  } else {
    return Error{"configuration: unknown question"};
  }
  configuration.send({{std::move(answer)}});
  return std::size_t{1};
}

Result<std::size_t> SidePorts::listen(Bytes said) {
  if (said.size() < 2) {
    return std::size_t{0};
  }
  if (said[0] != 255) {
    return Error{"microphone: raw sound only"};
  }
  hears = true;
  return std::size_t{2};
}

Result<std::size_t> SidePorts::recognize(Bytes said) {
  bool polled = false;
  {
    const MutexLock lock(mutex_);
    if (!vocabulary_) {
      auto words = read_vocabulary(said);
      if (!words) {
        return words.error();
      }
      if (!*words) {
        return std::size_t{0};
      }
      vocabulary_ = std::move((*words)->phrases);
      return (*words)->bytes;
    }
    polled = said[0] == kPollVoice;
    if (said[0] == kStopVoice) {
      vocabulary_.reset();
    }
  }
  if (polled) {
    voice.send({{voice_answer_bytes(results())}});
  }
  return std::size_t{1};
}

std::vector<VoiceResult> SidePorts::results() {
  const MutexLock lock(mutex_);
  std::vector<VoiceResult> all;
  for (const Phrase& phrase : phrases_) {
    const auto word = std::find(vocabulary_->begin(), vocabulary_->end(), phrase.text);
    VoiceResult& result = all.emplace_back();
    result.index = static_cast<std::uint32_t>(word - vocabulary_->begin());
    result.confidence = graded(phrase.confidence);
    result.start = static_cast<std::uint64_t>(ticks_100ns(phrase.time) + utc_offset_ticks_);
    result.raw_confidence = phrase.confidence;
  }
  phrases_.clear();
  return all;
}

Result<std::size_t> SidePorts::hear_client(Bytes said) {
  const auto read = read_standin_message(said);
  if (!read) {
    return read.error();
  }
  if (!*read) {
    return std::size_t{0};
  }
  const MutexLock lock(mutex_);
  if (const auto* shown = std::get_if<StandinShown>(&(*read)->message)) {
    if (shown_.size() < kMostWaiting) {
      shown_.push_back(shown->frame);
    }
  } else if (const auto* took = std::get_if<StandinTook>(&(*read)->message)) {
    heard_took_ = std::max(heard_took_, took->pair_time);
  } else {
    return Error{"stand-in: a message that only a server sends"};
  }
  return (*read)->bytes;
}

void SidePorts::send_to_client(const StandinMessage& message) {
  std::vector<std::uint8_t> bytes;
  append(bytes, message);
  standin.send({{std::move(bytes)}});
}

void SidePorts::greet(const StandinHello& hello) {
  {
    const MutexLock lock(mutex_);
    hello_ = hello;
    heard_took_ = took_ = Timestamp::min();
    phrases_.clear();
    shown_.clear();
  }
  send_to_client(hello);
}

void SidePorts::end() {
  {
    const MutexLock lock(mutex_);
    hello_.reset();
  }
  send_to_client(StandinEnd{});
}

void SidePorts::tell(const std::vector<ClickerEvent>& clicks, const std::vector<Phrase>& phrases,
                     const StandinUpTo& up_to) {
  if (!clicks.empty()) {
    send_to_client(StandinClicks{clicks});
  }
  send_to_client(up_to);
  const MutexLock lock(mutex_);
  if (phrases_.size() < kMostWaiting) {
    phrases_.insert(phrases_.end(), phrases.begin(), phrases.end());
  }
  if (hello_) {
    hello_->clock = up_to.clock;
  }
}

std::vector<WornFrame> SidePorts::take_shown() {
  const MutexLock lock(mutex_);
  return std::exchange(shown_, {});
}

bool SidePorts::took(Timestamp pair_time) const {
  const MutexLock lock(mutex_);
  return took_ >= pair_time;
}

void SidePorts::wait_for_took() {
  const MutexLock lock(mutex_);
  took_changed_.wait_until(mutex_, std::chrono::steady_clock::now() + std::chrono::milliseconds(2));
}

void SidePorts::publish_took() {
  {
    const MutexLock lock(mutex_);
    if (took_ == heard_took_) {
      return;
    }
    took_ = heard_took_;
  }
  took_changed_.notify_all();
}

}  // namespace orthonav::hl2ss
