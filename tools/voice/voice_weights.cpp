// Trains the weights of a command's evidence (hal/voice/command_weights.h): speaks commands and
// other sentences in noise, in the voices and texts kept for tuning, and fits a logistic regression
// to the recogniser's results. Takes one core a quarter of an hour.
#include <algorithm>
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <set>
#include <sstream>

#include "engine/session/spoken_commands.h"
#include "hal/voice/command_evidence.h"
#include "hal/voice/command_spotter.h"
#include "tests/support/noisy_speech.h"
#include "tools/voice/evidence_regression.h"
#include "tools/voice/phrase_in_room.h"
#include "tools/voice/voice_sets.h"
#include "tools/voice/voice_texts.h"

namespace orthonav::bench {
namespace {

using namespace orthonav::voice;
using namespace orthonav::test;

/// Something said once, and the evidence that the recogniser found in it.
struct Example {
  CommandEvidence evidence;
  bool command = false;  ///< a command was said, and that command was heard
  double weight = 1.0;
};

struct Examples {
  std::vector<Example> all;
  int commands_said = 0;
  int others_said = 0;
};

struct Options {
  std::string out;
  int every = 1;
  /// The fraction of phrases other than commands that may pass for one.
  double false_fraction = 0.0045;
  /// The same for single words, which are harder to tell from commands.
  double false_fraction_alone = 0.02;
};

[[noreturn]] void give_up(const std::string& why) {
  std::fprintf(stderr, "voice_weights: %s\n", why.c_str());
  std::exit(2);
}

struct Saying {
  std::string text;
  Speaker speaker;
  Noise noise = Noise::kWhite;
  double snr_db = 60.0;
  Babble babble = Babble::kTuning;
};

class Listener {
 public:
  Listener() {
    options_.commands = engine::trained_commands();
    auto recognizer =
        PhraseRecognizer::create(options_.phrases(), options_.wake_word, options_.acoustic_model);
    if (!recognizer) {
      give_up(recognizer.error().message);
    }
    recognizer_ = std::move(*recognizer);
  }
  std::vector<CommandEvidence> hear(const Saying& saying) {
    const auto said = spoken(saying.text, saying.speaker);
    if (!said) {
      give_up(said.error().message);
    }
    const auto phrase = phrase_in_room(*said, saying.noise, saying.snr_db, random_, saying.babble);
    std::vector<CommandEvidence> found;
    for (const SpeechSegment& segment : cut_out(phrase.sound)) {
      if (auto evidence = evidence_in(segment, options_, *recognizer_)) {
        found.push_back(std::move(*evidence));
      }
    }
    return found;
  }

 private:
  SpotterOptions options_;
  std::unique_ptr<PhraseRecognizer> recognizer_;
  Random random_{51};
};

void add_commands(Listener& listener, const Options& options, Examples& examples) {
  int count = 0;
  for (const std::string_view voice : kTuningVoices) {
    for (const int speed : {120, 160, 200}) {
      for (const std::string& command : engine::trained_commands()) {
        for (const double snr_db : {60.0, 20.0, 15.0, 10.0}) {
          for (const Noise noise : {Noise::kWhite, Noise::kPink, Noise::kBabble}) {
            for (const char* wake : {"ortho ", ""}) {
              if (snr_db == 60.0 && noise != Noise::kWhite) {
                continue;
              }
              if (count++ % options.every != 0) {
                continue;
              }
              ++examples.commands_said;
              for (CommandEvidence& evidence :
                   listener.hear({wake + command, {std::string(voice), speed}, noise, snr_db})) {
                const bool right =
                    evidence.command == command && evidence.wake.has_value() == (*wake != 0);
                if (right) {
                  examples.all.push_back({std::move(evidence), true, 1.0});
                }
              }
            }
          }
        }
      }
    }
  }
}

/// Every sentence, and every run of up to five of its words.
std::vector<std::string> fragments() {
  std::set<std::string> found;
  for (const std::string_view sentence : kTuningTalk) {
    found.emplace(sentence);
    std::string plain(sentence);
    std::erase_if(plain, [](char c) { return c == '.' || c == ',' || c == '?'; });
    std::istringstream text(plain);
    std::vector<std::string> words;
    for (std::string word; text >> word;) {
      words.push_back(word);
    }
    for (std::size_t first = 0; first < words.size(); ++first) {
      std::string fragment = words[first];
      found.insert(fragment);
      for (std::size_t i = first + 1; i < std::min(first + 5, words.size()); ++i) {
        found.insert(fragment += " " + words[i]);
      }
    }
  }
  return {found.begin(), found.end()};
}

/// Words of the acoustic model's dictionary, one to three at a time.
std::vector<std::string> random_words(Random& random) {
  std::ifstream file(default_acoustic_model().parent_path() / "cmudict-en-us.dict");
  std::vector<std::string> words;
  for (std::string line; std::getline(file, line);) {
    const std::string word = line.substr(0, line.find(' '));
    if (std::all_of(word.begin(), word.end(), [](char c) { return c >= 'a' && c <= 'z'; })) {
      words.push_back(word);
    }
  }
  if (words.empty()) {
    give_up("the acoustic model comes without a dictionary");
  }
  const auto word = [&] {
    return words[static_cast<std::size_t>(random.uniform() * static_cast<double>(words.size()))];
  };
  std::vector<std::string> texts;
  for (int i = 0; i < 400; ++i) {
    std::string text = word();
    for (int more = i % 3; more > 0; --more) {
      text += " " + word();
    }
    texts.push_back(text);
  }
  return texts;
}

std::vector<std::string> near_phrases() {
  std::vector<std::string> texts;
  for (const std::string_view first : kNearWakeWord) {
    for (std::size_t i = 0; i < std::size(kNearCommands); ++i) {
      if ((texts.size() + i) % 4 == 0) {
        texts.push_back(std::string(first) + " " + std::string(kNearCommands[i]));
      }
    }
  }
  return texts;
}

void add_others(Listener& listener, const Options& options, Examples& examples) {
  Random random(52);
  std::vector<std::pair<std::string, double>> texts;
  for (std::string& text : fragments()) {
    texts.emplace_back(std::move(text), 1.0);
  }
  for (std::string& text : random_words(random)) {
    texts.emplace_back(std::move(text), 1.0);
  }
  // Phrases that cannot be told from a command weigh little.
  for (std::string& text : near_phrases()) {
    texts.emplace_back(std::move(text), 0.3);
  }
  std::size_t count = 0;
  for (const auto& [text, weight] : texts) {
    for (int again = 0; again < 2; ++again) {
      const std::size_t at = count++;
      const std::string_view variant = kTrainingVariants[at % std::size(kTrainingVariants)];
      const std::string_view accent = kTrainingAccents[at % std::size(kTrainingAccents)];
      const double snr_db = random.uniform() < 0.2 ? 60.0 : random.uniform(8.0, 24.0);
      const auto noise = static_cast<Noise>(static_cast<int>(3.0 * random.uniform()));
      const int speed = static_cast<int>(random.uniform(125.0, 205.0));
      if (at % static_cast<std::size_t>(options.every) != 0) {
        continue;
      }
      ++examples.others_said;
      for (CommandEvidence& evidence :
           listener.hear({text,
                          {std::string(accent) + "+" + std::string(variant), speed},
                          noise,
                          snr_db,
                          Babble::kTraining})) {
        examples.all.push_back({std::move(evidence), false, weight});
      }
    }
  }
}

std::string text_of(double weight) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.3f", weight);
  return text;
}

std::string shared_row(const Weights& weights) {
  std::string text = "    {";
  for (std::size_t i = weights.size() - kEvidenceFeatures; i < weights.size(); ++i) {
    text += text_of(weights[i]) + ",";
  }
  return text + "},\n";
}

/// The text of hal/voice/command_weights.h, still to be formatted by clang-format.
std::string header(const std::vector<std::string>& commands, const Weights& after_wake_word,
                   const Weights& alone) {
  std::string text =
      "#pragma once\n\n#include \"hal/voice/command_evidence.h\"\n\nnamespace orthonav::voice {\n\n"
      "// Made by tools/voice/voice_weights.cpp, the shared weights in the order of "
      "features_of().\n"
      "inline constexpr CommandWeight kCommandWeights[] = {\n";
  for (std::size_t i = 0; i < commands.size(); ++i) {
    text += "    {\"" + commands[i] + "\", " + text_of(after_wake_word[i]) + ", " +
            text_of(alone[i]) + "},\n";
  }
  return text + "};\ninline constexpr EvidenceWeights kTrainedWeights = {\n    kCommandWeights,\n" +
         shared_row(after_wake_word) + shared_row(alone) +
         "};\n\n}  // namespace orthonav::voice\n";
}

int run(const Options& options) {
  Listener listener;
  Examples examples;
  add_commands(listener, options, examples);
  add_others(listener, options, examples);
  const std::vector<std::string> commands = engine::trained_commands();
  const auto train = [&](bool wake, double false_fraction) {
    std::vector<Row> rows;
    for (const Example& example : examples.all) {
      if (example.evidence.wake.has_value() == wake) {
        rows.push_back({inputs_of(example.evidence, commands), example.command, example.weight});
      }
    }
    Weights weights = fit(rows, commands.size());
    std::printf("%s, of %d commands and %d other sayings:\n",
                wake ? "after the wake word" : "alone", examples.commands_said / 2,
                examples.others_said);
    draw_line(rows, static_cast<std::size_t>(false_fraction * examples.others_said),
              commands.size(), weights);
    return weights;
  };
  const Weights after_wake_word = train(true, options.false_fraction);
  const Weights alone = train(false, options.false_fraction_alone);
  if (!(std::ofstream(options.out) << header(commands, after_wake_word, alone))) {
    give_up("can't write " + options.out);
  }
  return 0;
}

}  // namespace
}  // namespace orthonav::bench

int main(int argc, char** argv) {
  orthonav::bench::Options options;
  CLI::App app("Trains the weights of the evidence for a spoken command");
  app.add_option("--out", options.out, "the header to write: hal/voice/command_weights.h")
      ->required();
  app.add_option("--every", options.every, "uses every n-th saying only")->capture_default_str();
  app.add_option("--false-share", options.false_fraction, "fraction of other sayings that may pass")
      ->capture_default_str();
  app.add_option("--false-share-alone", options.false_fraction_alone, "the same, of single words")
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  return orthonav::bench::run(options);
}
