#include "hal/desktop/phrase_recognizer.h"

#include <pocketsphinx.h>
#include <sphinxbase/ckd_alloc.h>
#include <sphinxbase/err.h>

#include <cmath>
#include <set>
#include <sstream>
#include <utility>

#include "hal/desktop/pronunciations.h"

namespace orthonav::desktop {

namespace {

constexpr const char* kCommands = "commands";
constexpr const char* kAnything = "anything";

// PocketSphinx counts likelihoods in powers of 1.0001, in units of 1024.
const double kNatural = 1024.0 * std::log(1.0001);

struct FreeConfig {
  void operator()(cmd_ln_t* config) const { cmd_ln_free_r(config); }
};

std::set<std::string> words_of(const std::vector<std::string>& phrases) {
  std::set<std::string> words;
  for (const std::string& phrase : phrases) {
    std::istringstream text(phrase);
    for (std::string word; text >> word;) words.insert(word);
  }
  return words;
}

std::string phrases_grammar(const std::vector<std::string>& phrases) {
  std::string grammar = "#JSGF V1.0; grammar g; public <phrase> = ";
  for (std::size_t i = 0; i < phrases.size(); ++i) grammar += (i ? " | " : "") + phrases[i];
  return grammar + ";";
}

/// Any sounds in any order, or words that resemble a phrase.
std::string anything_grammar() {
  std::string grammar = "#JSGF V1.0; grammar g; public <anything> = (";
  for (std::size_t i = 0; i < kPhones.size(); ++i)
    grammar += (i ? " | " : "") + sound_word(kPhones[i]);
  grammar += ")+";
  for (const Pronunciation& other : kOthers) grammar += " | " + std::string(other.word);
  return grammar + ";";
}

}  // namespace

void PhraseRecognizer::Free::operator()(ps_decoder_s* decoder) const { ps_free(decoder); }

std::filesystem::path default_acoustic_model() {
  return "/usr/share/pocketsphinx/model/en-us/en-us";
}

Result<std::unique_ptr<PhraseRecognizer>> PhraseRecognizer::create(
    const std::vector<std::string>& phrases, const std::filesystem::path& model) {
  std::error_code code;
  if (!std::filesystem::exists(model / "mdef", code))
    return Error{"voice: no acoustic model in " + model.string() + " (Debian: pocketsphinx-en-us)"};
  err_set_logfp(nullptr);
  const std::string hmm = model.string();
  const std::unique_ptr<cmd_ln_t, FreeConfig> config(
      cmd_ln_init(nullptr, ps_args(), TRUE, "-hmm", hmm.c_str(), "-remove_silence", "no",
                  "-remove_noise", "no", "-bestpath", "no", "-logfn", "/dev/null", nullptr));
  if (!config) return Error{"voice: PocketSphinx refuses its options"};
  std::unique_ptr<PhraseRecognizer> recognizer(new PhraseRecognizer);
  recognizer->decoder_.reset(ps_init(config.get()));
  if (!recognizer->decoder_)
    return Error{"voice: PocketSphinx can't read the acoustic model in " + hmm};
  if (Status added = recognizer->add_words(); !added) return added.error();
  ps_decoder_t* decoder = recognizer->decoder_.get();
  for (const std::string& word : words_of(phrases))
    if (char* sounds = ps_lookup_word(decoder, word.c_str()); sounds)
      ckd_free(sounds);
    else
      return Error{"voice: nobody knows how \"" + word + "\" is pronounced"};
  if (ps_set_jsgf_string(decoder, kCommands, phrases_grammar(phrases).c_str()) != 0)
    return Error{"voice: PocketSphinx refuses the grammar of the phrases"};
  if (ps_set_jsgf_string(decoder, kAnything, anything_grammar().c_str()) != 0)
    return Error{"voice: PocketSphinx refuses its grammar of other sounds"};
  return recognizer;
}

Status PhraseRecognizer::add_words() {
  const auto add = [&](const std::string& word, const std::string& sounds) {
    return ps_add_word(decoder_.get(), word.c_str(), sounds.c_str(), FALSE) >= 0;
  };
  for (const auto& list :
       {std::span<const Pronunciation>(kSpoken), std::span<const Pronunciation>(kOthers)})
    for (const Pronunciation& p : list)
      if (!add(std::string(p.word), std::string(p.sounds)))
        return Error{"voice: PocketSphinx refuses the pronunciation of " + std::string(p.word)};
  for (const std::string_view phone : kPhones)
    if (!add(sound_word(phone), std::string(phone)))
      return Error{"voice: the acoustic model has no sound " + std::string(phone)};
  return {};
}

std::optional<PhraseRecognizer::Decoded> PhraseRecognizer::decode(
    const char* search, std::span<const std::int16_t> samples) {
  ps_decoder_t* decoder = decoder_.get();
  if (ps_set_search(decoder, search) != 0 || ps_start_utt(decoder) != 0) return std::nullopt;
  // Not as one whole utterance: its mean would be taken of half a second of sound, where that over
  // all that was heard so far tells far better what the microphone does to a voice.
  const int taken = ps_process_raw(decoder, samples.data(), samples.size(), FALSE, FALSE);
  if (ps_end_utt(decoder) != 0 || taken < 0) return std::nullopt;
  int32 score = 0;
  const char* text = ps_get_hyp(decoder, &score);
  if (!text) return std::nullopt;
  Decoded decoded{text, score * kNatural, 0};
  for (ps_seg_t* part = ps_seg_iter(decoder); part; part = ps_seg_next(part)) {
    int first = 0;
    int last = 0;
    ps_seg_frames(part, &first, &last);
    // Silences and breaths are "<sil>" and "[NOISE]".
    const std::string word = ps_seg_word(part);
    if (!word.empty() && word.front() != '<' && word.front() != '[')
      decoded.speech_frames += last - first + 1;
  }
  return decoded;
}

std::optional<Recognition> PhraseRecognizer::recognize(std::span<const std::int16_t> samples) {
  const auto phrase = decode(kCommands, samples);
  if (!phrase || phrase->speech_frames == 0) return std::nullopt;
  const auto anything = decode(kAnything, samples);
  if (!anything) return std::nullopt;
  return Recognition{phrase->text, (phrase->score - anything->score) / phrase->speech_frames};
}

}  // namespace orthonav::desktop
