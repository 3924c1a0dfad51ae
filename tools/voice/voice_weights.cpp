// What the odds of a command are weighed with (hal/voice/command_weights.h): says commands and
// other things in noise, in the voices and texts that thresholds are chosen on, and separates what
// the recogniser tells of them by logistic regression. A quarter of an hour of one core.
#include <algorithm>
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <Eigen/Dense>
#include <fstream>
#include <set>
#include <sstream>

#include "engine/session/spoken_commands.h"
#include "hal/voice/command_evidence.h"
#include "hal/voice/command_spotter.h"
#include "tests/support/noisy_speech.h"
#include "tools/voice/phrase_in_room.h"
#include "tools/voice/voice_sets.h"
#include "tools/voice/voice_texts.h"

namespace orthonav::bench {
namespace {

using namespace orthonav::voice;
using namespace orthonav::test;

/// What was said once, and what was made of it.
struct Example {
  CommandEvidence evidence;
  bool command = false;  ///< it was said, and heard as what it is
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
  /// Of what is said beside and decoded as a command, so much may pass.
  double false_fraction = 0.0045;
  /// Single words can't be told from others that well; what passes of these is reported.
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
    options_.commands = engine::spoken_commands();
    auto recognizer = PhraseRecognizer::create(options_.phrases(), options_.acoustic_model);
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
  int turn = 0;
  for (const std::string_view voice : kTuningVoices) {
    for (const int speed : {120, 160, 200}) {
      for (const std::string& command : engine::spoken_commands()) {
        for (const double snr_db : {60.0, 20.0, 15.0, 10.0}) {
          for (const Noise noise : {Noise::kWhite, Noise::kPink, Noise::kBabble}) {
            for (const char* wake : {"ortho ", ""}) {
              if (snr_db == 60.0 && noise != Noise::kWhite) {
                continue;
              }
              if (turn++ % options.every != 0) {
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

/// Every run of up to five words of the sentences, and these whole.
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
  // What nobody would tell from a command weighs little.
  for (std::string& text : near_phrases()) {
    texts.emplace_back(std::move(text), 0.3);
  }
  std::size_t turn = 0;
  for (const auto& [text, weight] : texts) {
    for (int again = 0; again < 2; ++again) {
      const std::size_t at = turn++;
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

using Weights = Eigen::Matrix<double, std::tuple_size_v<FeatureVector>, 1>;

/// Logistic regression by Newton's method, with a normal prior of variance 2 on each weight but the
/// constant.
Weights fit(const std::vector<Example>& examples) {
  constexpr double kPrior = 0.5;
  Weights weights = Weights::Zero();
  for (int step = 0; step < 50; ++step) {
    Weights gradient = kPrior * weights;
    Eigen::Matrix<double, Weights::RowsAtCompileTime, Weights::RowsAtCompileTime> hessian =
        kPrior * decltype(hessian)::Identity();
    gradient[kWeighedCommands.size()] = 0.0;
    hessian(kWeighedCommands.size(), kWeighedCommands.size()) = 1e-9;
    for (const Example& example : examples) {
      const FeatureVector features = features_of(example.evidence);
      const Eigen::Map<const Weights> x(features.data());
      const double p = 1.0 / (1.0 + std::exp(-weights.dot(x)));
      gradient += example.weight * (p - (example.command ? 1.0 : 0.0)) * x;
      hessian += example.weight * p * (1.0 - p) * x * x.transpose();
    }
    const Weights change = hessian.ldlt().solve(gradient);
    weights -= change;
    if (change.norm() < 1e-9) {
      break;
    }
  }
  return weights;
}

/// Moves the constant to where the line is drawn, and says what passes there.
void draw_line(const std::vector<Example>& examples, int commands_said, int others_said,
               double fraction, const char* name, Weights& weights) {
  std::vector<double> others;
  const auto odds = [&](const Example& example) {
    const FeatureVector features = features_of(example.evidence);
    return weights.dot(Eigen::Map<const Weights>(features.data()));
  };
  for (const Example& example : examples) {
    if (!example.command && example.weight == 1.0) {
      others.push_back(odds(example));
    }
  }
  std::sort(others.begin(), others.end(), std::greater<>());
  const auto pass = static_cast<std::size_t>(fraction * others_said);
  const double line = others.size() > pass ? std::max(others[pass], 0.0) : 0.0;
  int heard = 0, near = 0, nears = 0;
  for (const Example& example : examples) {
    heard += example.command && odds(example) > line ? 1 : 0;
    if (example.weight == 1.0) {
      continue;
    }
    ++nears;
    near += odds(example) > line ? 1 : 0;
  }
  weights[kWeighedCommands.size()] -= line;
  std::printf(
      "%s: line at %.2f, %zu of %d other sayings pass, %d of %d near ones, %.1f %% of the "
      "commands\n",
      name, line, pass, others_said, near, nears, 100.0 * heard / commands_said);
}

std::string table(const char* name, const Weights& weights) {
  std::string text = "inline constexpr FeatureVector " + std::string(name) + " = {\n    ";
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    char number[32];
    std::snprintf(number, sizeof(number), "%.3f", weights[i]);
    text += (i == 0 ? "" : i == 11 ? ",\n    " : ", ") + std::string(number);
  }
  return text + "};\n";
}

int run(const Options& options) {
  Listener listener;
  Examples examples;
  add_commands(listener, options, examples);
  add_others(listener, options, examples);
  std::string header =
      "#pragma once\n\n#include \"hal/voice/command_evidence.h\"\n\nnamespace "
      "orthonav::voice {\n\n// Made by tools/voice/voice_weights.cpp, in the order of "
      "features_of().\n";
  for (const bool wake : {true, false}) {
    std::vector<Example> of_kind;
    for (const Example& example : examples.all) {
      if (example.evidence.wake.has_value() == wake) {
        of_kind.push_back(example);
      }
    }
    Weights weights = fit(of_kind);
    draw_line(of_kind, examples.commands_said / 2, examples.others_said,
              wake ? options.false_fraction : options.false_fraction_alone,
              wake ? "after the wake word" : "alone", weights);
    header += table(wake ? "kWeightsAfterWakeWord" : "kWeightsAlone", weights);
  }
  header += "\n}  // namespace orthonav::voice\n";
  if (!(std::ofstream(options.out) << header)) {
    give_up("can't write " + options.out);
  }
  return 0;
}

}  // namespace
}  // namespace orthonav::bench

int main(int argc, char** argv) {
  orthonav::bench::Options options;
  CLI::App app("Finds the weights that the odds of a command are made of");
  app.add_option("--out", options.out, "hal/voice/command_weights.h")->required();
  app.add_option("--every", options.every, "takes one saying of so many")->capture_default_str();
  app.add_option("--false-share", options.false_fraction, "of other sayings that pass")
      ->capture_default_str();
  app.add_option("--false-share-alone", options.false_fraction_alone, "the same, of single words")
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  return orthonav::bench::run(options);
}
