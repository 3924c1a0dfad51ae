#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "hal/hl2ss/bytes.h"

namespace orthonav::hl2ss {

inline constexpr std::uint8_t kStopVoice = 0;
inline constexpr std::uint8_t kPollVoice = 1;

/// u16 count, then each phrase as u16 byte length and UTF-16LE. Phrases are ASCII, at most 64 of at
/// most 256 letters.
Result<std::vector<std::uint8_t>> vocabulary_bytes(const std::vector<std::string>& phrases);
/// A vocabulary as parsed by a server, with its size in bytes; nothing while bytes are missing.
struct Vocabulary {
  std::vector<std::string> phrases;
  std::size_t bytes = 0;
};
Result<std::optional<Vocabulary>> read_vocabulary(Bytes bytes);

struct VoiceResult {
  std::uint32_t index = 0;       ///< into the phrases; their count: no match
  std::uint32_t confidence = 3;  ///< 0 high, 1 medium, 2 low, 3 rejected
  std::uint64_t duration = 0;
  std::uint64_t start = 0;
  double raw_confidence = 0.0;

  /// On the scale of `Phrase`: 0.9, 0.6, 0.3, 0; raw confidences are not calibrated.
  [[nodiscard]] double confidence_of_phrase() const;
};
/// One complete answer to a poll, with its size in bytes; nothing while bytes are missing. Too many
/// results or an unknown confidence give an Error, since the rest can't be trusted.
struct VoiceAnswer {
  std::vector<VoiceResult> results;
  std::size_t bytes = 0;
};
Result<std::optional<VoiceAnswer>> read_voice_answer(Bytes bytes);
[[nodiscard]] std::vector<std::uint8_t> voice_answer_bytes(const std::vector<VoiceResult>& results);

}  // namespace orthonav::hl2ss
