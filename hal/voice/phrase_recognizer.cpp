#include "hal/voice/phrase_recognizer.h"

#include <pocketsphinx.h>
#include <sphinxbase/ckd_alloc.h>
#include <sphinxbase/err.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <sstream>
#include <utility>

#include "base/memory_file.h"
#include "embedded/voice_means.h"
#include "embedded/voice_mixtures.h"
#include "hal/voice/adapted_means.h"
#include "hal/voice/adapted_mixtures.h"
#include "hal/voice/pronunciations.h"

namespace orthonav::voice {

namespace {

constexpr const char* kCommands = "commands";
constexpr const char* kAnything = "anything";
constexpr const char* kAnswer = "answer";

// PocketSphinx counts likelihoods in powers of 1.0001, in units of 1024.
const double kNatural = 1024.0 * std::log(1.0001);

/// By how much more likely an answer is, as a logarithm, than its sound alone says: a command that
/// it resembles must be clearly ahead. "Stop" and "start" differ in one sound, and the means are
/// adapted to the latter.
constexpr double kAnswerAhead = 40.0;
/// The evidence where the same segment, heard with every sound, is another phrase.
constexpr double kOtherPhrase = -100.0;

struct FreeConfig {
  void operator()(cmd_ln_t* config) const { cmd_ln_free_r(config); }
};

std::set<std::string> words_of(const std::vector<std::string>& phrases) {
  std::set<std::string> words;
  for (const std::string& phrase : phrases) {
    std::istringstream text(phrase);
    for (std::string word; text >> word;) {
      words.insert(word);
    }
  }
  return words;
}

/// An answer's name in a grammar: some are among the other words too, said in another way.
std::string answer_word(const Pronunciation& answer) {
  return "answer-" + std::string(answer.word);
}

std::string phrases_grammar(const std::vector<std::string>& phrases) {
  std::string grammar = "#JSGF V1.0; grammar g; public <phrase> = ";
  for (std::size_t i = 0; i < phrases.size(); ++i) {
    grammar += (i ? " | " : "") + phrases[i];
  }
  return grammar + ";";
}

/// Any sounds in any order.
std::string sounds() {
  std::string some = "(";
  for (std::size_t i = 0; i < kPhones.size(); ++i) {
    some += (i ? " | " : "") + sound_word(kPhones[i]);
  }
  return some + ")+";
}

/// Any sounds, or words that resemble a phrase.
std::string anything() {
  std::string text = sounds();
  for (const Pronunciation& other : kOthers) {
    text += " | " + std::string(other.word);
  }
  return text;
}

std::string grammar_of(const std::string& phrase) {
  return "#JSGF V1.0; grammar g; public <phrase> = " + phrase + ";";
}

std::string answers() {
  std::string text;
  for (const Pronunciation& answer : kAnswers) {
    text += (text.empty() ? "" : " | ") + answer_word(answer);
  }
  return text;
}

Result<MemoryFile> in_memory(std::string_view content) {
  auto file = MemoryFile::create(content);
  return file ? std::move(file) : Error{"voice: " + file.error().message, file.error().code};
}

Result<MemoryFile> adapted_means(const std::filesystem::path& model) {
  auto means = read_means(model / "means");
  if (!means) {
    return means.error();
  }
  if (Status moved = apply_change(embedded::voice_means(), *means); !moved) {
    return moved.error();
  }
  return in_memory(means_file(*means));
}

Result<MemoryFile> adapted_mixtures(const std::filesystem::path& model) {
  auto mixtures = read_mixture_weights(model / "sendump");
  if (!mixtures) {
    return mixtures.error();
  }
  if (Status moved = apply_change(embedded::voice_mixtures(), *mixtures); !moved) {
    return moved.error();
  }
  return in_memory(mixture_weights_file(*mixtures));
}

}  // namespace

void PhraseRecognizer::Free::operator()(ps_decoder_s* decoder) const { ps_free(decoder); }

std::filesystem::path default_acoustic_model() {
  return "/usr/share/pocketsphinx/model/en-us/en-us";
}

Result<std::unique_ptr<PhraseRecognizer>> PhraseRecognizer::create(
    const std::vector<std::string>& phrases, const std::string& wake_word,
    const std::filesystem::path& model) {
  std::error_code code;
  if (!std::filesystem::exists(model / "mdef", code)) {
    return Error{"voice: no acoustic model in " + model.string() + " (Debian: pocketsphinx-en-us)",
                 ErrorCode::kNotFound};
  }
  err_set_logfp(nullptr);
  std::unique_ptr<PhraseRecognizer> recognizer(new PhraseRecognizer);
  recognizer->wake_word_ = wake_word;
  for (const bool every_sound : {false, true}) {
    auto decoder = open(model, every_sound);
    if (!decoder) {
      return decoder.error();
    }
    if (Status added = add_words(decoder->get()); !added) {
      return added.error();
    }
    (every_sound ? recognizer->comparing_ : recognizer->decoder_) = *std::move(decoder);
  }
  if (Status listening = recognizer->add_grammars(phrases); !listening) {
    return listening.error();
  }
  return recognizer;
}

Result<PhraseRecognizer::Decoder> PhraseRecognizer::open(const std::filesystem::path& model,
                                                         bool every_sound) {
  const auto means = adapted_means(model);
  if (!means) {
    return means.error();
  }
  const auto mixtures = adapted_mixtures(model);
  if (!mixtures) {
    return mixtures.error();
  }
  // The model's noise words could explain the rest of a sentence after a word; silence can't.
  const auto silences = in_memory("<s> SIL\n</s> SIL\n<sil> SIL\n");
  if (!silences) {
    return silences.error();
  }
  const std::string hmm = model.string();
  // The model's own feat.params come after "-cmn none": PocketSphinx takes the mean of the cepstra
  // that it is given out of them, in place.
  const std::unique_ptr<cmd_ln_t, FreeConfig> config(
      cmd_ln_init(nullptr, ps_args(), TRUE, "-hmm", hmm.c_str(), "-mean", means->path().c_str(),
                  "-sendump", mixtures->path().c_str(), "-fdict", silences->path().c_str(), "-cmn",
                  "none", "-remove_silence", "no", "-remove_noise", "no", "-bestpath", "no",
                  "-compallsen", every_sound ? "yes" : "no", "-logfn", "/dev/null", nullptr));
  if (!config) {
    return Error{"voice: PocketSphinx refuses its options"};
  }
  Decoder decoder(ps_init(config.get()));
  if (!decoder) {
    return Error{"voice: PocketSphinx can't read the acoustic model in " + hmm};
  }
  return decoder;
}

Status PhraseRecognizer::add_grammars(const std::vector<std::string>& phrases) {
  for (const std::string& word : words_of(phrases)) {
    if (char* sounds = ps_lookup_word(decoder_.get(), word.c_str()); sounds) {
      ckd_free(sounds);
    } else {
      return Error{"voice: nobody knows how \"" + word + "\" is pronounced"};
    }
  }
  for (ps_decoder_t* decoder : {decoder_.get(), comparing_.get()}) {
    if (ps_set_jsgf_string(decoder, kCommands, phrases_grammar(phrases).c_str()) != 0) {
      return Error{"voice: PocketSphinx refuses the grammar of the phrases"};
    }
  }
  const auto after_wake_word = [&](const std::string& what) {
    return grammar_of(wake_word_ + " (" + what + ")");
  };
  if (ps_set_jsgf_string(decoder_.get(), kAnything, grammar_of(anything()).c_str()) != 0 ||
      ps_set_jsgf_string(comparing_.get(), kAnything, after_wake_word(anything()).c_str()) != 0 ||
      ps_set_jsgf_string(comparing_.get(), kAnswer, after_wake_word(answers()).c_str()) != 0) {
    return Error{"voice: PocketSphinx refuses its grammar of other sounds"};
  }
  return {};
}

Status PhraseRecognizer::add_words(ps_decoder_s* decoder) {
  const auto add = [&](const std::string& word, const std::string& sounds) {
    return ps_add_word(decoder, word.c_str(), sounds.c_str(), FALSE) >= 0;
  };
  for (const auto& list :
       {std::span<const Pronunciation>(kSpoken), std::span<const Pronunciation>(kOthers)}) {
    for (const Pronunciation& p : list) {
      if (!add(std::string(p.word), std::string(p.sounds))) {
        return Error{"voice: PocketSphinx refuses the pronunciation of " + std::string(p.word)};
      }
    }
  }
  for (const Pronunciation& answer : kAnswers) {
    if (!add(answer_word(answer), std::string(answer.sounds))) {
      return Error{"voice: PocketSphinx refuses the pronunciation of " + answer_word(answer)};
    }
  }
  for (const std::string_view phone : kPhones) {
    if (!add(sound_word(phone), std::string(phone))) {
      return Error{"voice: the acoustic model has no sound " + std::string(phone)};
    }
  }
  return {};
}

/// Alters the cepstra: PocketSphinx takes their mean out.
std::vector<PhraseRecognizer::Part> PhraseRecognizer::decode(ps_decoder_s* decoder,
                                                             const char* search,
                                                             std::vector<Cepstrum>& cepstra) {
  std::vector<mfcc_t*> rows;
  rows.reserve(cepstra.size());
  for (Cepstrum& cepstrum : cepstra) {
    rows.push_back(cepstrum.data());
  }
  if (ps_set_search(decoder, search) != 0 || ps_start_utt(decoder) != 0) {
    return {};
  }
  const int taken =
      ps_process_cep(decoder, rows.data(), static_cast<int>(rows.size()), FALSE, TRUE);
  int32 score = 0;
  if (ps_end_utt(decoder) != 0 || taken < 0 || !ps_get_hyp(decoder, &score)) {
    return {};
  }
  std::vector<Part> parts;
  for (ps_seg_t* seg = ps_seg_iter(decoder); seg; seg = ps_seg_next(seg)) {
    Part part;
    int32 acoustic = 0, language = 0, back_off = 0;
    ps_seg_frames(seg, &part.first, &part.last);
    ps_seg_prob(seg, &acoustic, &language, &back_off);
    part.score = (acoustic + language) * kNatural;
    part.word = ps_seg_word(seg);
    parts.push_back(std::move(part));
  }
  return parts;
}

Recognition PhraseRecognizer::recognize(std::span<const std::int16_t> samples) {
  std::vector<Cepstrum> cepstra = cepstra_of(ps_get_fe(decoder_.get()), samples);
  const auto frames = static_cast<int>(cepstra.size());
  const std::vector<Part> phrase = decode(decoder_.get(), kCommands, cepstra);
  // If no phrase fits to the end, the decoder returns one that ended earlier.
  if (phrase.empty() || phrase.back().last < frames - 1) {
    return {};
  }
  // The weights of the evidence were trained with the mean taken out twice here.
  std::vector<double> anything(cepstra.size(), 0.0);
  for (const Part& part : decode(decoder_.get(), kAnything, cepstra)) {
    for (int t = part.first; t <= std::min(part.last, frames - 1); ++t) {
      anything[static_cast<std::size_t>(t)] = part.score / (part.last - part.first + 1);
    }
  }
  Recognition recognition;
  for (const Part& part : phrase) {
    double evidence = part.score;
    for (int t = part.first; t <= part.last; ++t) {
      evidence -= anything[static_cast<std::size_t>(t)];
    }
    const int length = part.last - part.first + 1;
    // Silences are "<sil>", joints in a grammar are "(NULL)", and "save(2)" is another
    // pronunciation of "save".
    if (part.word.find_first_of("<(") == 0) {
      recognition.evidence_around += evidence;
    } else {
      recognition.words.push_back(
          {part.word.substr(0, part.word.find('(')), length, evidence / length});
    }
  }
  if (!recognition.words.empty() && recognition.words.front().word == wake_word_) {
    recognition.evidence_over_sounds = over_sounds(samples, recognition.words);
  }
  return recognition;
}

/// Every search hears the same features, and their likelihoods are relative to the same sounds.
double PhraseRecognizer::over_sounds(std::span<const std::int16_t> samples,
                                     const std::vector<RecognizedWord>& words) {
  const std::vector<Cepstrum> cepstra = cepstra_of(ps_get_fe(decoder_.get()), samples);
  const auto heard_by = [&](const char* search) {
    std::vector<Cepstrum> own = cepstra;
    std::vector<Part> parts = decode(comparing_.get(), search, own);
    if (!parts.empty() && parts.back().last < static_cast<int>(cepstra.size()) - 1) {
      parts.clear();
    }
    return parts;
  };
  const auto score_of = [](const std::vector<Part>& parts) {
    return parts.empty()
               ? -std::numeric_limits<double>::infinity()
               : std::accumulate(parts.begin(), parts.end(), 0.0,
                                 [](double sum, const Part& part) { return sum + part.score; });
  };
  const std::vector<Part> phrase = heard_by(kCommands);
  int frames = 0;
  std::size_t at = 0;
  bool same = true;
  for (const Part& part : phrase) {
    if (part.word.find_first_of("<(") == 0) {
      continue;
    }
    same = same && at < words.size() && part.word.substr(0, part.word.find('(')) == words[at].word;
    frames += at++ == 0 ? 0 : part.last - part.first + 1;
  }
  if (!same || at != words.size() || frames == 0) {
    return kOtherPhrase;
  }
  const double others =
      std::max(score_of(heard_by(kAnything)), score_of(heard_by(kAnswer)) + kAnswerAhead);
  return std::isfinite(others) ? (score_of(phrase) - others) / frames : 0.0;
}

}  // namespace orthonav::voice
