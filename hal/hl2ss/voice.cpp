#include "hal/hl2ss/voice.h"

#include <array>

#include "hal/hl2ss/protocol.h"

namespace orthonav::hl2ss {
namespace {

constexpr std::size_t kMaxPhrases = 64;
constexpr std::size_t kMaxLetters = 256;
constexpr std::array kConfidences = {0.9, 0.6, 0.3, 0.0};

}  // namespace

Result<std::vector<std::uint8_t>> vocabulary_bytes(const std::vector<std::string>& phrases) {
  if (phrases.size() > kMaxPhrases) {
    return Error{"voice: " + std::to_string(phrases.size()) + " phrases, limit " +
                 std::to_string(kMaxPhrases)};
  }
  std::vector<std::uint8_t> bytes;
  append(bytes, static_cast<std::uint16_t>(phrases.size()));
  for (const std::string& phrase : phrases) {
    if (phrase.empty() || phrase.size() > kMaxLetters) {
      return Error{"voice: phrase of " + std::to_string(phrase.size()) + " letters, must be 1 to " +
                   std::to_string(kMaxLetters)};
    }
    append(bytes, static_cast<std::uint16_t>(2 * phrase.size()));
    for (const char letter : phrase) {
      if (static_cast<unsigned char>(letter) > 127) {
        return Error{"voice: phrase \"" + phrase + "\" is not ASCII"};
      }
      append(bytes, static_cast<std::uint16_t>(letter));
    }
  }
  return bytes;
}

Result<std::optional<Vocabulary>> read_vocabulary(Bytes bytes) {
  using Answer = std::optional<Vocabulary>;
  ByteReader reader(bytes);
  Vocabulary read;
  const auto count = reader.take<std::uint16_t>();
  if (count > kMaxPhrases) {
    return Error{"voice: " + std::to_string(count) + " phrases, limit " +
                 std::to_string(kMaxPhrases)};
  }
  for (std::uint16_t i = 0; i < count && reader.ok(); ++i) {
    const auto length = reader.take<std::uint16_t>();
    if (length % 2 != 0 || length > 2 * kMaxLetters) {
      return Error{"voice: phrase of " + std::to_string(length) +
                   " bytes, must be even and up to " + std::to_string(2 * kMaxLetters)};
    }
    const Bytes letters = reader.take_bytes(length);
    std::string& phrase = read.phrases.emplace_back();
    for (std::size_t at = 0; at < letters.size(); at += 2) {
      const auto unit = number_at<std::uint16_t>(letters, at);
      if (unit > 127) {
        return Error{"voice: phrase " + std::to_string(i) + " is not ASCII"};
      }
      phrase += static_cast<char>(unit);
    }
  }
  if (!reader.ok()) {
    return Answer{};
  }
  read.bytes = bytes.size() - reader.left();
  return Answer{std::move(read)};
}

double VoiceResult::confidence_of_phrase() const {
  return confidence < kConfidences.size() ? kConfidences[confidence] : 0.0;
}

Result<std::optional<VoiceAnswer>> read_voice_answer(Bytes bytes) {
  using Answer = std::optional<VoiceAnswer>;
  if (bytes.size() < 4) {
    return Answer{};
  }
  const auto count = number_at<std::uint32_t>(bytes, 0);
  if (count > kMaxVoiceResults) {
    return Error{"voice: " + std::to_string(count) + " results, limit " +
                 std::to_string(kMaxVoiceResults)};
  }
  VoiceAnswer answer;
  answer.bytes = 4 + kVoiceResultBytes * count;
  if (bytes.size() < answer.bytes) {
    return Answer{};
  }
  ByteReader reader(bytes.subspan(4));
  for (std::uint32_t i = 0; i < count; ++i) {
    VoiceResult result;
    result.index = reader.take<std::uint32_t>();
    result.confidence = reader.take<std::uint32_t>();
    result.duration = reader.take<std::uint64_t>();
    result.start = reader.take<std::uint64_t>();
    result.raw_confidence = reader.take<double>();
    if (result.confidence >= kConfidences.size()) {
      return Error{"voice: confidence " + std::to_string(result.confidence) + ", must be 0 to 3"};
    }
    answer.results.push_back(result);
  }
  return Answer{std::move(answer)};
}

std::vector<std::uint8_t> voice_answer_bytes(const std::vector<VoiceResult>& results) {
  std::vector<std::uint8_t> bytes;
  append(bytes, static_cast<std::uint32_t>(results.size()));
  for (const VoiceResult& result : results) {
    append(bytes, result.index);
    append(bytes, result.confidence);
    append(bytes, result.duration);
    append(bytes, result.start);
    append(bytes, result.raw_confidence);
  }
  return bytes;
}

}  // namespace orthonav::hl2ss
