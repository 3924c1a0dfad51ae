// Adapts the acoustic model to commands in noise (tools/voice/train): speaks the commands in voices
// that are used in no measurement, in noises of all sorts, and writes what the recogniser derives
// from them in sphinxtrain's format; afterwards turns sphinxtrain's results into
// data/voice_means.bin and data/voice_mixtures.bin.
#include <pocketsphinx.h>
#include <sphinxbase/err.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>

#include "engine/session/spoken_commands.h"
#include "hal/voice/adapted_means.h"
#include "hal/voice/adapted_mixtures.h"
#include "hal/voice/model_bytes.h"
#include "hal/voice/phrase_recognizer.h"
#include "hal/voice/pronunciations.h"
#include "hal/voice/speech_cleaner.h"
#include "tests/support/noisy_speech.h"
#include "tools/voice/phrase_in_room.h"
#include "tools/voice/sphinx_mixture.h"
#include "tools/voice/voice_sets.h"

namespace orthonav::bench {
namespace {

using namespace orthonav::voice;
using namespace orthonav::test;

struct Options {
  std::string folder;
  std::string means;            ///< to align with; empty: the model's own
  std::string mixture;          ///< output file for the model's mixture weights
  std::string change;           ///< output file for the change that leads to `means`
  double fraction = 0.6;        ///< of the way
  std::string adapted_mixture;  ///< an adapted model's mixture weights
  std::string mixture_change;   ///< output file for the change that leads to them
  double mixture_fraction = 0.6;
};

[[noreturn]] void give_up(const std::string& why) {
  std::fprintf(stderr, "voice_training: %s\n", why.c_str());
  std::exit(2);
}

void write_file(const std::string& path, const std::string& content) {
  std::ofstream file(path, std::ios::binary);
  if (!(file << content)) {
    give_up("can't write " + path);
  }
}

/// Finds with the model which pronunciation of a phrase was used.
class Aligner {
 public:
  explicit Aligner(const Options& options) {
    err_set_logfp(nullptr);
    const std::string model = default_acoustic_model().string();
    const std::string means = options.means.empty() ? model + "/means" : options.means;
    write_file(options.folder + "/fillers", "<s> SIL\n</s> SIL\n<sil> SIL\n");
    // The phrase is known, so no beam may lose it.
    config_ = cmd_ln_init(nullptr, ps_args(), TRUE, "-hmm", model.c_str(), "-mean", means.c_str(),
                          "-fdict", (options.folder + "/fillers").c_str(), "-cmn", "none",
                          "-remove_silence", "no", "-remove_noise", "no", "-bestpath", "no",
                          "-beam", "1e-200", "-pbeam", "1e-200", "-wbeam", "1e-150", "-logfn",
                          "/dev/null", nullptr);
    decoder_.reset(config_ ? ps_init(config_) : nullptr);
    if (!decoder_) {
      give_up("PocketSphinx can't start");
    }
    for (const Pronunciation& p : kSpoken) {
      ps_add_word(decoder_.get(), p.word.data(), p.sounds.data(), FALSE);
    }
  }
  [[nodiscard]] fe_t* front_end() const { return ps_get_fe(decoder_.get()); }

  /// As a line of sphinxtrain's transcription, "ortho(2) save(4)"; empty if nothing fits.
  std::string words_of(const std::string& phrase, std::vector<Cepstrum>& cepstra) {
    ps_decoder_t* decoder = decoder_.get();
    const std::string grammar = "#JSGF V1.0; grammar g; public <phrase> = " + phrase + ";";
    std::vector<mfcc_t*> rows;
    for (Cepstrum& cepstrum : cepstra) {
      rows.push_back(cepstrum.data());
    }
    ps_set_jsgf_string(decoder, "phrase", grammar.c_str());
    ps_set_search(decoder, "phrase");
    ps_start_utt(decoder);
    ps_process_cep(decoder, rows.data(), static_cast<int>(rows.size()), FALSE, FALSE);
    ps_end_utt(decoder);
    int32 score = 0;
    if (!ps_get_hyp(decoder, &score)) {
      return "";
    }
    std::string words;
    std::string silence;
    for (ps_seg_t* seg = ps_seg_iter(decoder); seg; seg = ps_seg_next(seg)) {
      const std::string word = ps_seg_word(seg);
      if (word == "<sil>" && !words.empty()) {
        silence = " <sil>";
      }
      if (word.find_first_of("<(") == 0) {
        continue;
      }
      words += (words.empty() ? "" : silence + " ") + word;
      silence.clear();
    }
    return words;
  }

 private:
  struct Free {
    void operator()(ps_decoder_t* decoder) const { ps_free(decoder); }
  };
  cmd_ln_t* config_ = nullptr;  // for the life of the process
  std::unique_ptr<ps_decoder_t, Free> decoder_;
};

/// Microphones make a voice brighter or duller.
void tilt(std::vector<std::int16_t>& samples, double fraction) {
  double before = 0.0;
  for (std::int16_t& sample : samples) {
    const double now = sample;
    sample = static_cast<std::int16_t>(0.5 * (now + fraction * before));
    before = now;
  }
}

/// A phrase in noise, as the recogniser receives it; nothing unless the segmenter finds exactly one
/// phrase.
std::vector<std::int16_t> heard(const std::string& phrase, const std::string& voice,
                                Random& random) {
  const int words_a_minute = static_cast<int>(random.uniform(115.0, 210.0));
  const bool silent = random.uniform() < 0.15;
  const double snr_db = random.uniform(8.0, 22.0);
  const auto noise = static_cast<Noise>(static_cast<int>(3.0 * random.uniform()));
  const double tilted = random.uniform(-0.5, 0.5);
  auto said = spoken(phrase, {voice, words_a_minute});
  if (!said) {
    give_up(said.error().message);
  }
  tilt(*said, tilted);
  const auto room = phrase_in_room(*said, noise, silent ? 60.0 : snr_db, random, Babble::kTraining);
  const auto segments = cut_out(room.sound);
  if (segments.size() != 1) {
    return {};
  }
  return cleaned(segments.front().samples, kBackgroundSamples);
}

/// The recogniser's input, phrase by phrase, in sphinxtrain's format.
class Corpus {
 public:
  explicit Corpus(const Options& options) : folder_(options.folder), aligner_(options) {}

  /// Leaves out phrases that no pronunciation fits.
  void add(const std::string& phrase, const std::string& voice) {
    std::vector<Cepstrum> cepstra = cepstra_of(aligner_.front_end(), heard(phrase, voice, random_));
    const std::string words = cepstra.empty() ? "" : aligner_.words_of(phrase, cepstra);
    if (words.empty()) {
      return;
    }
    const std::string name = "phrase-" + std::to_string(count_++);
    std::string file;
    put(file, static_cast<std::int32_t>(cepstra.size() * cepstra.front().size()));
    for (const Cepstrum& cepstrum : cepstra) {
      put(file, cepstrum);
    }
    write_file(folder_ + "/" + name + ".mfc", file);
    names_ += name + "\n";
    transcription_ += "<s> " + words + " </s> (" + name + ")\n";
  }
  void write_lists() const {
    std::string dictionary;
    for (const Pronunciation& p : kSpoken) {
      dictionary += std::string(p.word) + " " + std::string(p.sounds) + "\n";
    }
    write_file(folder_ + "/names", names_);
    write_file(folder_ + "/transcription", transcription_);
    write_file(folder_ + "/dictionary", dictionary);
    std::printf("%d phrases\n", count_);
  }

 private:
  std::string folder_;
  Aligner aligner_;
  Random random_{131};
  std::string names_;
  std::string transcription_;
  int count_ = 0;
};

void write_corpus(const Options& options) {
  Corpus corpus(options);
  std::size_t voice = 0;
  for (const std::string_view variant : kTrainingVariants) {
    for (std::size_t accent = 0; accent < std::size(kTrainingAccents) / 2; ++accent) {
      for (const std::string& command : engine::trained_commands()) {
        for (const char* wake : {"", "", "ortho ", "ortho "}) {
          corpus.add(
              wake + command,
              std::string(kTrainingAccents[(voice + 2 * accent) % std::size(kTrainingAccents)]) +
                  "+" + std::string(variant));
        }
      }
    }
    ++voice;
  }
  corpus.write_lists();
}

MixtureWeights own_mixture_weights() {
  auto own = read_mixture_weights(default_acoustic_model() / "sendump");
  if (!own) {
    give_up(own.error().message);
  }
  return std::move(*own);
}

void write_mixture_change(const Options& options) {
  const auto change = sphinx_mixture_change(own_mixture_weights(), options.adapted_mixture,
                                            options.mixture_fraction);
  if (!change) {
    give_up(change.error().message);
  }
  write_file(options.mixture_change, *change);
}

void write_change(const Options& options) {
  const auto own = read_means(default_acoustic_model() / "means");
  auto adapted = read_means(options.means);
  if (!own || !adapted) {
    give_up((own ? adapted.error() : own.error()).message);
  }
  if (adapted->values.size() != own->values.size()) {
    give_up(options.means + " is another model's");
  }
  for (std::size_t i = 0; i < own->values.size(); ++i) {
    adapted->values[i] =
        std::lerp(own->values[i], adapted->values[i], static_cast<float>(options.fraction));
  }
  write_file(options.change, means_change(*own, *adapted));
}

}  // namespace
}  // namespace orthonav::bench

int main(int argc, char** argv) {
  orthonav::bench::Options options;
  CLI::App app("Adapts the acoustic model to commands in noise; see tools/voice/train");
  app.add_option("--corpus", options.folder, "a folder for what the recogniser hears");
  app.add_option("--means", options.means, "an adapted model's means");
  app.add_option("--mixture-weights", options.mixture, "a file for the model's own");
  app.add_option("--change", options.change, "a file for what leads from the model to --means");
  app.add_option("--share", options.fraction, "of the way")->capture_default_str();
  app.add_option("--adapted-mixture-weights", options.adapted_mixture, "an adapted model's");
  app.add_option("--mixture-change", options.mixture_change,
                 "a file for what leads from the model to --adapted-mixture-weights");
  app.add_option("--mixture-share", options.mixture_fraction, "of the way")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  using namespace orthonav::bench;
  if (!options.mixture.empty()) {
    write_file(options.mixture, sphinx_mixture_weights(own_mixture_weights()));
  }
  if (!options.folder.empty()) {
    write_corpus(options);
  }
  if (!options.change.empty()) {
    write_change(options);
  }
  if (!options.mixture_change.empty()) {
    write_mixture_change(options);
  }
  return 0;
}
