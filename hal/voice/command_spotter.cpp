#include "hal/voice/command_spotter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/joined.h"

namespace orthonav::voice {

namespace {

constexpr double kHardlyLikely = 0.25;

}  // namespace

std::vector<std::string> SpotterOptions::phrases() const {
  std::vector<std::string> phrases;
  for (const std::string& command : commands) {
    phrases.push_back(wake_word + " " + command);
    phrases.push_back(command);
  }
  return phrases;
}

std::optional<CommandEvidence> evidence_in(const SpeechSegment& segment,
                                           const SpotterOptions& options,
                                           PhraseRecognizer& recognizer) {
  const Recognition heard =
      recognizer.recognize(cleaned(segment.samples, kBackgroundSamples, options.cleaner));
  return evidence_of(heard, options.wake_word, segment.above_background_db);
}

std::vector<std::string> SpotterOptions::check() const {
  std::vector<std::string> problems;
  if (commands.empty()) {
    problems.push_back("voice: no command to listen for");
  }
  if (!std::isfinite(least_log_odds) || !std::isfinite(more_log_odds_to_decide)) {
    problems.push_back("voice: log odds must be finite");
  }
  if (segments.margin_ms < 400) {
    problems.push_back("voice: margin_ms must be at least 400");
  }
  if (segments.max_ms < 500 || segments.max_ms > 3000) {
    problems.push_back("voice: max_ms must lie in [500, 3000]");
  }
  if (segments.end_ms < 150 || segments.end_in_noise_ms < segments.end_ms ||
      segments.end_in_noise_ms > 1000) {
    problems.push_back("voice: end_ms and end_in_noise_ms must lie in [150, 1000], in this order");
  }
  return problems;
}

CommandSpotter::CommandSpotter(const SpotterOptions& options)
    : options_(options), segmenter_(options.segments) {}

Result<std::unique_ptr<CommandSpotter>> CommandSpotter::create(const SpotterOptions& options) {
  if (const auto problems = options.check(); !problems.empty()) {
    return Error{joined(problems)};
  }
  auto recognizer =
      PhraseRecognizer::create(options.phrases(), options.wake_word, options.acoustic_model);
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
  const auto evidence = evidence_in(segment, options_, *recognizer_);
  if (!evidence) {
    return std::nullopt;
  }
  const double confidence = confidence_of(*evidence);
  if (confidence < kHardlyLikely) {
    return std::nullopt;
  }
  return SpokenCommand{evidence->command, confidence, segment.begin, segment.end};
}

double CommandSpotter::confidence_of(const CommandEvidence& evidence) const {
  // The odds say that a command was said, the comparison that no other word was: both must.
  const bool deletes = evidence.command == "delete";
  const bool decides = deletes || evidence.command == "accept" || evidence.command == "start";
  const double more = options_.more_log_odds_to_decide;
  const double said = log_odds(evidence, options_.weights) - (deletes ? more : 0.0);
  const double over = log_odds_over_other_words(evidence, said) - (decides ? more : 0.0);
  const double odds = evidence.wake ? std::min(said, over) : said;
  const double confidence = 1.0 / (1.0 + std::exp(options_.least_log_odds - odds));
  const bool quiet = evidence.above_background_db >= options_.quiet_above_db;
  const bool counts = evidence.wake || options_.waking == Waking::kNever ||
                      (options_.waking == Waking::kInNoise && quiet);
  // It was heard but is not executed; the status line says so.
  return counts ? confidence : std::min(confidence, 0.49);
}

}  // namespace orthonav::voice
