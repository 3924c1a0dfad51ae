#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "hal/voice/speech_features.h"

struct ps_decoder_s;

namespace orthonav::voice {

/// Where Debian's pocketsphinx-en-us puts its acoustic model.
[[nodiscard]] std::filesystem::path default_acoustic_model();

/// A word of a phrase.
struct RecognizedWord {
  std::string word;
  int frames = 0;  ///< of 10 ms
  /// How much better the word explains its stretch of sound than any other sounds: the natural
  /// logarithm of the likelihood ratio per 10 ms. Well below zero: something else was said.
  double evidence = 0.0;
};

/// The phrase that a segment of speech, from one silence to the next, sounds most like.
struct Recognition {
  std::vector<RecognizedWord> words;  ///< in their order; empty if no phrase fits at all
  /// How much better silence explains the rest of the segment than other sounds: the natural
  /// logarithm of the likelihood ratio. Far below zero: more than the phrase was said.
  double evidence_around = 0.0;
  /// Where the wake word comes first: how much better the phrase explains the segment than the wake
  /// word and anything else after it, as the natural logarithm of the likelihood ratio per 10 ms
  /// of what follows it. Below zero: another word followed.
  double evidence_over_sounds = 0.0;
};

/// Decides which of a few phrases a segment of speech is: PocketSphinx with a grammar of the
/// phrases, compared with a second grammar in which any sounds, and words that resemble a phrase,
/// may follow one another, and with a third in which any sounds follow the wake word. The acoustic
/// model's means are adapted to words in noise after cleaning (data/voice_means.bin,
/// tools/voice/train). One thread at a time.
class PhraseRecognizer {
 public:
  /// Refuses a missing model, and phrases with a word whose pronunciation is not known.
  static Result<std::unique_ptr<PhraseRecognizer>> create(const std::vector<std::string>& phrases,
                                                          const std::string& wake_word,
                                                          const std::filesystem::path& model);
  /// Takes samples at `kSpeechRateHz`.
  [[nodiscard]] Recognition recognize(std::span<const std::int16_t> samples);

 private:
  struct Free {
    void operator()(ps_decoder_s* decoder) const;
  };
  /// A word or a single sound, and its frames.
  struct Part {
    std::string word;
    int first = 0;  ///< frame
    int last = 0;
    double score = 0.0;  ///< natural logarithm of its likelihood
  };
  using Decoder = std::unique_ptr<ps_decoder_s, Free>;
  Decoder decoder_;
  /// Computes the likelihood of every sound, so that two of its searches can be compared: otherwise
  /// likelihoods are relative to the best of those sounds that a search looks at.
  Decoder comparing_;
  std::string wake_word_;

  static Result<Decoder> open(const std::filesystem::path& model, bool every_sound);
  static Status add_words(ps_decoder_s* decoder);
  Status add_grammars(const std::vector<std::string>& phrases);
  static std::vector<Part> decode(ps_decoder_s* decoder, const char* search,
                                  std::vector<Cepstrum>& cepstra);
  double over_sounds(std::span<const std::int16_t> samples,
                     const std::vector<RecognizedWord>& words);
};

}  // namespace orthonav::voice
