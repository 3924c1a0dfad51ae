#include "hal/voice/command_spotter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/joined.h"

namespace orthonav::voice {
namespace {

/// Said before each command.
constexpr const char* kWakeWord = "ortho";

}  // namespace

std::vector<std::string> SpotterOptions::check() const {
  std::vector<std::string> problems;
  if (commands.empty()) {
    problems.push_back("voice: no command to listen for");
  }
  if (!std::isfinite(least_log_odds)) {
    problems.push_back("voice: log odds must be finite");
  }
  return problems;
}

CommandSpotter::CommandSpotter(const SpotterOptions& options) : options_(options) {}

Result<std::unique_ptr<CommandSpotter>> CommandSpotter::create(const SpotterOptions& options) {
  if (const auto problems = options.check(); !problems.empty()) {
    return Error{joined(problems)};
  }
  auto recognizer = PhraseRecognizer::create(options.commands, kWakeWord, options.acoustic_model);
  if (!recognizer) {
    return recognizer.error();
  }
  std::unique_ptr<CommandSpotter> spotter(new CommandSpotter(options));
  spotter->recognizer_ = std::move(*recognizer);
  return spotter;
}

void CommandSpotter::push(std::span<const std::int16_t> samples,
                          std::vector<SpokenCommand>& commands) {
  segments_.clear();
  segmenter_.push(samples, segments_);
  for (const SpeechSegment& segment : segments_) {
    if (!segment.ended) {
      candidate_ = judge(segment);
    } else if (const auto command = std::exchange(candidate_, std::nullopt); command) {
      commands.push_back(*command);
    }
  }
}

std::optional<SpokenCommand> CommandSpotter::judge(const SpeechSegment& segment) {
  const auto evidence =
      evidence_of(recognizer_->recognize(cleaned(segment.samples, kBackgroundSamples)), kWakeWord);
  if (!evidence ||
      std::ranges::find(options_.commands, evidence->command) == options_.commands.end()) {
    return std::nullopt;
  }
  const double odds = log_odds(*evidence);
  if (odds < 0.0) {
    return std::nullopt;
  }
  const double confidence = 1.0 / (1.0 + std::exp(options_.least_log_odds - odds));
  return SpokenCommand{evidence->command, confidence, segment.begin, segment.end};
}

}  // namespace orthonav::voice
