// Commands and other speech, spoken by espeak-ng, against noise: how many commands are heard, how
// many are heard without having been said, in talk and as other words after the wake word, and how
// long it takes. With --tuning, uses the voices
// and texts on which the thresholds were chosen; otherwise those not used for that. Nothing is
// stored.
#include <algorithm>
#include <array>
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <map>
#include <memory>
#include <sstream>

#include "bench/phrase_in_room.h"
#include "bench/voice_sets.h"
#include "bench/voice_texts.h"
#include "bench/wilson.h"
#include "engine/session/workflow/commands.h"
#include "hal/voice/command_spotter.h"
#include "tests/support/noisy_speech.h"

namespace orthonav::bench {
namespace {

using namespace orthonav::voice;
using namespace orthonav::test;

constexpr double kClean = 60.0;  ///< dB: a silent room

struct Options {
  bool tuning = false;
  bool fresh = false;
  bool quick = false;
  bool addressed = false;
  bool show = false;
  double minutes = 10.0;
};

/// Who speaks and what, and who babbles in the background.
struct VoiceSet {
  const char* name;
  std::span<const std::string_view> voices;
  std::span<const std::string_view> talk;
  std::string_view words;  ///< that are no commands
  Babble babble;
  std::uint64_t seed;
};
VoiceSet set_of(const Options& options) {
  if (options.tuning) {
    return {"tuning", kTuningVoices, kTuningTalk, kTuningWords, Babble::kTuning, 1};
  }
  if (options.fresh) {
    return {"fresh", kFreshVoices, kTestTalk, kFreshWords, Babble::kMeasured, 3};
  }
  return {"test", kTestVoices, kTestTalk, kUnseenWords, Babble::kMeasured, 2};
}

struct Tally {
  int said = 0;
  int heard = 0;     ///< with certainty, as what was said
  int mistaken = 0;  ///< with certainty, as another command
};

/// How sure the recogniser was of each saying: what another line would make of them.
struct Sureness {
  std::vector<double> right;  ///< log odds of commands heard as what was said; absent where not
  std::vector<double> other;  ///< of words that are no commands
  int commands = 0;
  int words = 0;
};

struct Figures {
  std::map<std::string, Tally> by_command;
  std::map<std::string, Tally> by_condition;
  std::vector<double> latencies_ms;
  Tally all;
};

std::vector<std::string> listed(std::string_view words) {
  std::vector<std::string> list;
  std::istringstream text{std::string(words)};
  for (std::string word; std::getline(text >> std::ws, word, ',');) {
    list.push_back(word);
  }
  return list;
}

/// How far above the line a confidence lies, as log odds.
double above_line(const SpokenCommand& found) {
  return std::log(found.confidence / (1.0 - found.confidence));
}

/// CPU time of this thread: the time that the work takes on a free core, however busy the machine
/// is.
double worked_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

std::unique_ptr<CommandSpotter> new_spotter() {
  SpotterOptions options;
  options.commands = engine::spotted_phrases();
  auto spotter = CommandSpotter::create(options);
  if (spotter) {
    return std::move(*spotter);
  }
  std::fprintf(stderr, "%s\n", spotter.error().message.c_str());
  std::exit(2);
}

/// Feeds 10 ms at a time, as a microphone does. Calls `heard(command, ms)` with the time since the
/// sound began at which a free core would have done the command's work and all before it.
template <class Heard>
void listen(CommandSpotter& spotter, std::span<const std::int16_t> sound, Heard heard) {
  constexpr std::size_t kStep = 160;
  std::vector<SpokenCommand> commands;
  double done_ms = 0.0;
  for (std::size_t at = 0; at < sound.size(); at += kStep) {
    commands.clear();
    const double start_ms = worked_ms();
    spotter.push(sound.subspan(at, std::min(kStep, sound.size() - at)), commands);
    const double fed_ms = static_cast<double>(at + kStep) / 16.0;
    done_ms = std::max(done_ms, fed_ms) + worked_ms() - start_ms;
    for (const SpokenCommand& command : commands) {
      heard(command, done_ms);
    }
  }
}

void say_one(CommandSpotter& spotter, const std::string& command, const Options& options,
             const Speaker& speaker, Noise noise, double snr_db, Random& random, Figures& figures,
             Sureness& sureness) {
  const auto said = spoken("ortho " + command, speaker);
  if (!said) {
    return;
  }
  const auto phrase = phrase_in_room(*said, noise, snr_db, random, set_of(options).babble);
  bool heard = false;
  bool mistaken = false;
  sureness.commands += 1;
  listen(spotter, phrase.sound, [&](const SpokenCommand& found, double ms) {
    if (found.text == command) {
      sureness.right.push_back(above_line(found));
    }
    if (options.show) {
      std::printf("%s %d %s %.0f dB: %s %+.2f\n", speaker.voice.c_str(), speaker.words_a_minute,
                  command.c_str(), snr_db, found.text.c_str(), above_line(found));
    }
    if (found.confidence < 0.5) {
      return;
    }
    if (found.text == command && !heard) {
      heard = true;
      figures.latencies_ms.push_back(ms - static_cast<double>(phrase.end) / 16.0);
    } else if (found.text != command) {
      mistaken = true;
    }
  });
  std::string condition = "clean";
  if (snr_db < kClean) {
    condition = std::to_string(static_cast<int>(snr_db)) + " dB " + name_of(noise);
  }
  for (Tally* tally :
       {&figures.by_command[command], &figures.by_condition[condition], &figures.all}) {
    tally->said += 1;
    tally->heard += heard ? 1 : 0;
    tally->mistaken += mistaken ? 1 : 0;
  }
}

void print(const char* name, const std::map<std::string, Tally>& tallies) {
  for (const auto& [key, tally] : tallies) {
    const FractionInterval heard = wilson(tally.heard, static_cast<std::size_t>(tally.said));
    std::printf("%-10s %-12s said %4d  heard %6.1f %% (%.1f to %.1f)  mistaken %5.1f %%\n", name,
                key.c_str(), tally.said, 100.0 * tally.heard / tally.said, 100.0 * heard.low,
                100.0 * heard.high, 100.0 * tally.mistaken / tally.said);
  }
}

double quantile(std::vector<double> values, double fraction) {
  if (values.empty()) {
    return 0.0;
  }
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1,
                         static_cast<std::size_t>(fraction * static_cast<double>(values.size())))];
}

void measure_recall(const Options& options, Sureness& sureness) {
  const VoiceSet set = set_of(options);
  Random random(10 + set.seed);
  Figures figures;
  std::size_t count = 0;
  const std::vector<int> speeds =
      options.quick ? std::vector<int>{150} : std::vector<int>{120, 160, 200};
  for (const std::string_view voice : set.voices) {
    // One surgeon each, in a room whose noise changes.
    const auto spotter = new_spotter();
    for (const double snr_db : {kClean, 20.0, 15.0, 10.0}) {
      for (const int speed : speeds) {
        for (const std::string& command : engine::spotted_phrases()) {
          const auto noise = static_cast<Noise>(count++ % 3);
          say_one(*spotter, command, options, {std::string(voice), speed}, noise, snr_db, random,
                  figures, sureness);
        }
      }
    }
    count += 1;  // every command meets every noise
  }
  std::printf("\n%zu voices\n", set.voices.size());
  print("command", figures.by_command);
  print("condition", figures.by_condition);
  print("all", {{"", figures.all}});
  std::printf("latency after the phrase's end: median %.0f ms, p99 %.0f ms\n",
              quantile(figures.latencies_ms, 0.5), quantile(figures.latencies_ms, 0.99));
}

void measure_false_accepts(const Options& options, double snr_db) {
  const VoiceSet set = set_of(options);
  const auto spotter = new_spotter();
  Random random(20 + set.seed);
  std::map<std::string, int> accepted;
  double heard_s = 0.0;
  int total = 0;
  for (std::size_t i = 0; heard_s < 60.0 * options.minutes; ++i) {
    const std::string text(set.talk[i % set.talk.size()]);
    const int speed = 130 + static_cast<int>(20 * (i % 4));
    const auto said = spoken(text, {std::string(set.voices[(i / 3) % set.voices.size()]), speed});
    if (!said) {
      continue;
    }
    Soundtrack track;
    track.speech(*said);
    track.silence(random.uniform(0.3, 1.2));
    const auto sound = track.with_noise(static_cast<Noise>(i / 10 % 3), snr_db, random, set.babble);
    heard_s += static_cast<double>(sound.size()) / kSpeechRateHz;
    listen(*spotter, sound, [&](const SpokenCommand& found, double) {
      if (options.show) {
        std::printf("\"%s\" %.0f dB: %s %+.2f\n", text.c_str(), snr_db, found.text.c_str(),
                    above_line(found));
      }
      if (found.confidence < 0.5) {
        return;
      }
      accepted[found.text] += 1;
      total += 1;
    });
  }
  std::printf("%4.1f dB, %.1f min: %.1f false accepts in 10 min, %d of them delete\n", snr_db,
              heard_s / 60.0, 600.0 * total / heard_s, accepted["delete last"]);
}

/// Words that are no commands where a command is expected: whatever is heard with certainty is
/// wrong.
void measure_other_words(const Options& options, const char* name, std::string_view words,
                         Sureness& sureness) {
  const VoiceSet set = set_of(options);
  Random random(30 + set.seed);
  std::map<std::string, Tally> by_condition;
  std::map<std::string, int> taken_for;
  int said_words = 0;
  int taken = 0;
  std::size_t count = 0;
  for (const std::string_view voice : set.voices) {
    const auto spotter = new_spotter();
    for (const std::string& word : listed(words)) {
      constexpr std::array kSnrsDb = {kClean, 20.0, 15.0, 10.0};
      const std::size_t at = count++;
      if (options.quick && at % 4 != 0) {
        continue;
      }
      const double snr_db = kSnrsDb[at / 4 % kSnrsDb.size()];
      const auto noise = static_cast<Noise>(at / 16 % 3);
      const int speed = 120 + 40 * static_cast<int>(at / 4 % 3);
      const auto said = spoken("ortho " + word, {std::string(voice), speed});
      if (!said) {
        continue;
      }
      const auto phrase = phrase_in_room(*said, noise, snr_db, random, set.babble);
      bool sure = false;
      sureness.words += 1;
      listen(*spotter, phrase.sound, [&](const SpokenCommand& found, double) {
        sureness.other.push_back(above_line(found));
        if (options.show) {
          std::printf("\"ortho %s\" %s %d %.0f dB %s: %s %+.2f\n", word.c_str(),
                      std::string(voice).c_str(), speed, snr_db, name_of(noise), found.text.c_str(),
                      above_line(found));
        }
        if (found.confidence >= 0.5) {
          sure = true;
          taken_for[found.text] += 1;
        }
      });
      said_words += 1;
      taken += sure ? 1 : 0;
      Tally& tally = by_condition[snr_db < kClean ? std::to_string(static_cast<int>(snr_db)) + " dB"
                                                  : std::string("clean")];
      tally.said += 1;
      tally.mistaken += sure ? 1 : 0;
    }
    count += 1;  // every word meets every condition
  }
  const FractionInterval interval = wilson(taken, static_cast<std::size_t>(said_words));
  std::printf("%s: said %d, taken for a command %d (%.1f %%, %.1f to %.1f %%)\n", name, said_words,
              taken, 100.0 * taken / said_words, 100.0 * interval.low, 100.0 * interval.high);
  for (const auto& [condition, tally] : by_condition) {
    std::printf("  %-6s said %4d, taken %3d\n", condition.c_str(), tally.said, tally.mistaken);
  }
  for (const auto& [command, times] : taken_for) {
    std::printf("  as %s: %d\n", command.c_str(), times);
  }
}

/// What other lines would make of the same sounds; below the line, as far as what is not sure is
/// told.
void print_other_lines(const Sureness& sureness) {
  const double line = SpotterOptions().least_log_odds;
  std::printf("\nline: commands heard, other words taken\n");
  for (const double move : {-2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0}) {
    const auto above = [move](const std::vector<double>& odds) {
      return static_cast<double>(
          std::ranges::count_if(odds, [move](double x) { return x >= move; }));
    };
    const double right = above(sureness.right);
    const double other = above(sureness.other);
    const FractionInterval heard = wilson(right, static_cast<std::size_t>(sureness.commands));
    const FractionInterval taken = wilson(other, static_cast<std::size_t>(sureness.words));
    std::printf("  %+.1f  %5.1f %% (%.1f to %.1f)  %4.1f %% (%.1f to %.1f)\n", line + move,
                100.0 * right / sureness.commands, 100.0 * heard.low, 100.0 * heard.high,
                100.0 * other / sureness.words, 100.0 * taken.low, 100.0 * taken.high);
  }
}

int run(const Options& options) {
  std::printf("voice, %s set\n", set_of(options).name);
  Sureness sureness;
  measure_recall(options, sureness);
  std::printf("\nother words after the wake word\n");
  measure_other_words(options, "asked for", kAskedWords, sureness);
  measure_other_words(options, options.tuning ? "weighed" : "unseen", set_of(options).words,
                      sureness);
  print_other_lines(sureness);
  if (options.minutes <= 0.0 || options.addressed) {
    return 0;
  }
  std::printf("\nother speech\n");
  for (const double snr_db : {kClean, 20.0, 10.0}) {
    measure_false_accepts(options, snr_db);
  }
  return 0;
}

}  // namespace
}  // namespace orthonav::bench

int main(int argc, char** argv) {
  orthonav::bench::Options options;
  CLI::App app("Recall, false accepts and latency of voice commands");
  app.add_flag("--tuning", options.tuning, "the voices and texts that thresholds were chosen on");
  app.add_flag("--fresh", options.fresh, "voices that nothing was decided on")
      ->excludes("--tuning");
  app.add_flag("--addressed", options.addressed, "only what is said after the wake word");
  app.add_flag("--quick", options.quick,
               "one speed instead of three, a quarter of the other words");
  app.add_flag("--show", options.show, "everything that was heard");
  app.add_option("--minutes", options.minutes, "of other speech")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  return orthonav::bench::run(options);
}
