#include "hal/voice/phrase_recognizer.h"

#include <pocketsphinx.h>
#include <sphinxbase/ckd_alloc.h>
#include <sphinxbase/err.h>
#include <sphinxbase/fe.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "base/memory_file.h"
#include "hal/voice/pronunciations.h"

namespace orthonav::voice {

namespace {

constexpr const char* kCommands = "commands";
constexpr const char* kAnything = "anything";

// PocketSphinx counts likelihoods in powers of 1.0001, in units of 1024.
const double kNatural = 1024.0 * std::log(1.0001);

struct FreeConfig {
  void operator()(cmd_ln_t* config) const { cmd_ln_free_r(config); }
};

/// One of these.
std::string any_of(const std::vector<std::string>& texts) {
  std::string text;
  for (const std::string& each : texts) {
    text += (text.empty() ? "(" : " | ") + each;
  }
  return text + ")";
}

/// Any sounds in any order.
std::string anything() {
  std::vector<std::string> sounds;
  for (const std::string_view phone : kPhones) {
    sounds.push_back(sound_word(phone));
  }
  return any_of(sounds) + "+";
}

std::string grammar_of(const std::string& phrase) {
  return "#JSGF V1.0; grammar g; public <phrase> = " + phrase + ";";
}

}  // namespace

void PhraseRecognizer::Free::operator()(ps_decoder_s* decoder) const { ps_free(decoder); }

std::filesystem::path default_acoustic_model() {
  return "/usr/share/pocketsphinx/model/en-us/en-us";
}

Result<std::unique_ptr<PhraseRecognizer>> PhraseRecognizer::create(
    const std::vector<std::string>& commands, const std::string& wake_word,
    const std::filesystem::path& model) {
  std::error_code code;
  if (!std::filesystem::exists(model / "mdef", code)) {
    return Error{"voice: no acoustic model in " + model.string() + " (Debian: pocketsphinx-en-us)",
                 ErrorCode::kNotFound};
  }
  err_set_logfp(nullptr);
  // The model's noise words could explain the rest of a sentence after a word; silence can't.
  const auto silences = MemoryFile::create("<s> SIL\n</s> SIL\n<sil> SIL\n");
  if (!silences) {
    return Error{"voice: " + silences.error().message, silences.error().code};
  }
  // Without -compallsen, likelihoods are relative to the best of the sounds that a search looks at:
  // those of two searches could not be compared.
  const std::string hmm = model.string();
  const std::unique_ptr<cmd_ln_t, FreeConfig> config(
      cmd_ln_init(nullptr, ps_args(), TRUE, "-hmm", hmm.c_str(), "-fdict", silences->path().c_str(),
                  "-remove_silence", "no", "-remove_noise", "no", "-bestpath", "no", "-compallsen",
                  "yes", "-logfn", "/dev/null", nullptr));
  if (!config) {
    return Error{"voice: PocketSphinx refuses its options"};
  }
  std::unique_ptr<PhraseRecognizer> recognizer(new PhraseRecognizer);
  recognizer->wake_word_ = wake_word;
  recognizer->decoder_.reset(ps_init(config.get()));
  if (!recognizer->decoder_) {
    return Error{"voice: PocketSphinx can't read the acoustic model in " + hmm};
  }
  if (Status added = recognizer->add_words(); !added) {
    return added.error();
  }
  if (Status listening = recognizer->add_grammars(commands); !listening) {
    return listening.error();
  }
  return recognizer;
}

Status PhraseRecognizer::add_words() {
  const auto add = [&](const std::string& word, const std::string& sounds) {
    return ps_add_word(decoder_.get(), word.c_str(), sounds.c_str(), FALSE) >= 0;
  };
  for (const auto& list :
       {std::span<const Pronunciation>(kSpoken), std::span<const Pronunciation>(kOthers)}) {
    for (const Pronunciation& p : list) {
      if (!add(std::string(p.word), std::string(p.sounds))) {
        return Error{"voice: PocketSphinx refuses the pronunciation of " + std::string(p.word)};
      }
    }
  }
  for (const std::string_view phone : kPhones) {
    if (!add(sound_word(phone), std::string(phone))) {
      return Error{"voice: the acoustic model has no sound " + std::string(phone)};
    }
  }
  return {};
}

Status PhraseRecognizer::add_grammars(const std::vector<std::string>& commands) {
  for (const std::string& command : commands) {
    std::istringstream text(wake_word_ + " " + command);
    for (std::string word; text >> word;) {
      char* sounds = ps_lookup_word(decoder_.get(), word.c_str());
      if (!sounds) {
        return Error{"voice: nobody knows how \"" + word + "\" is pronounced"};
      }
      ckd_free(sounds);
    }
  }
  // Without commands alone, the wake word would be found in what precedes one; without answers and
  // other endings, "confirm" and "delete it" would be heard as what they resemble most.
  std::vector<std::string> phrases = commands;
  phrases.insert(phrases.end(), kAnswers.begin(), kAnswers.end());
  for (const std::string& command : commands) {
    phrases.push_back(command.substr(0, command.find(' ')) + " [" +
                      any_of(std::vector<std::string>(kOtherEndings.begin(), kOtherEndings.end())) +
                      "]");
  }
  const std::string addressed = grammar_of("[" + wake_word_ + "] " + any_of(phrases));
  if (ps_set_jsgf_string(decoder_.get(), kCommands, addressed.c_str()) != 0 ||
      ps_set_jsgf_string(decoder_.get(), kAnything, grammar_of(anything()).c_str()) != 0) {
    return Error{"voice: PocketSphinx refuses its grammars"};
  }
  return {};
}

/// Takes the cepstra by value: PocketSphinx takes their mean out in place.
std::vector<PhraseRecognizer::Part> PhraseRecognizer::decode(const char* search,
                                                             std::vector<Cepstrum> cepstra) {
  std::vector<mfcc_t*> rows;
  rows.reserve(cepstra.size());
  for (Cepstrum& cepstrum : cepstra) {
    rows.push_back(cepstrum.data());
  }
  ps_decoder_t* decoder = decoder_.get();
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
    part.score = acoustic * kNatural;
    part.word = ps_seg_word(seg);
    // Joints in a grammar, "(NULL)", take no frames.
    if (part.word.front() != '(') {
      parts.push_back(std::move(part));
    }
  }
  // If nothing fits to the end, the decoder returns what ended earlier.
  if (parts.empty() || parts.back().last < static_cast<int>(cepstra.size()) - 1) {
    return {};
  }
  return parts;
}

std::vector<PhraseRecognizer::Cepstrum> PhraseRecognizer::cepstra_of(
    std::span<const std::int16_t> samples) const {
  fe_t* const front_end = ps_get_fe(decoder_.get());
  mfcc_t** block = nullptr;
  int32 count = 0;
  if (fe_start_utt(front_end) != 0 ||
      fe_process_utt(front_end, samples.data(), samples.size(), &block, &count) != 0 || !block) {
    return {};
  }
  std::vector<Cepstrum> cepstra(static_cast<std::size_t>(std::max(count, 0)));
  for (std::size_t t = 0; t < cepstra.size(); ++t) {
    std::copy_n(block[t], cepstra[t].size(), cepstra[t].begin());
  }
  fe_free_2d(block);
  return cepstra;
}

Recognition PhraseRecognizer::recognize(std::span<const std::int16_t> samples) {
  const std::vector<Cepstrum> cepstra = cepstra_of(samples);
  const auto frames = static_cast<int>(cepstra.size());
  const std::vector<Part> phrase = decode(kCommands, cepstra);
  if (phrase.empty()) {
    return {};
  }
  std::vector<double> anything(cepstra.size(), 0.0);
  for (const Part& part : decode(kAnything, cepstra)) {
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
    // Silences are "<sil>", and "save(2)" is another pronunciation of "save".
    if (part.word.front() == '<') {
      recognition.evidence_around += evidence;
    } else {
      recognition.words.push_back(
          {part.word.substr(0, part.word.find('(')), length, evidence / length});
    }
  }
  return recognition;
}

}  // namespace orthonav::voice
