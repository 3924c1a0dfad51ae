#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/api/result.h"

struct ps_decoder_s;

namespace orthonav::desktop {

/// Where Debian's pocketsphinx-en-us puts its acoustic model.
[[nodiscard]] std::filesystem::path default_acoustic_model();

/// What a segment of speech sounds like most.
struct Recognition {
  std::string text;
  /// By how much the phrase explains the sound better than any other sounds do, in natural
  /// logarithms of likelihood for each 10 ms of speech. Below zero: something else was said.
  double evidence = 0.0;
};

/// Decides which of a few phrases a segment of speech is: PocketSphinx with a grammar of the
/// phrases, against a second one in which any sounds and words that resemble a phrase may follow
/// one another. One thread at a time.
class PhraseRecognizer {
 public:
  /// Refuses a model that is not there, and phrases with a word whose pronunciation is not known.
  static Result<std::unique_ptr<PhraseRecognizer>> create(const std::vector<std::string>& phrases,
                                                          const std::filesystem::path& model);
  /// Of samples at `kSpeechRateHz`; nothing where no phrase fits at all.
  [[nodiscard]] std::optional<Recognition> recognize(std::span<const std::int16_t> samples);

 private:
  struct Free {
    void operator()(ps_decoder_s* decoder) const;
  };
  struct Decoded {
    std::string text;
    double score = 0.0;
    int speech_frames = 0;
  };
  std::unique_ptr<ps_decoder_s, Free> decoder_;

  Status add_words();
  std::optional<Decoded> decode(const char* search, std::span<const std::int16_t> samples);
};

}  // namespace orthonav::desktop
