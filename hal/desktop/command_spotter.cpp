#include "hal/desktop/command_spotter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hal/api/joined.h"

namespace orthonav::desktop {

namespace {

constexpr double kHardlyLikely = 0.25;

}  // namespace

std::vector<std::string> SpotterOptions::check() const {
  std::vector<std::string> problems;
  if (commands.empty()) problems.push_back("voice: no command to listen for");
  bool finite = true;
  for (const double value :
       {least_evidence_of_others, least_evidence_of_wake_word, least_evidence_of_wake_word_in_noise,
        more_wake_evidence_to_delete, least_evidence_around, more_evidence_alone})
    finite = finite && std::isfinite(value);
  for (const auto& [command, least] : least_evidence) finite = finite && std::isfinite(least);
  if (!finite) problems.push_back("voice: evidence must be finite");
  if (segments.margin_ms < 400) problems.push_back("voice: margin_ms must be at least 400");
  if (segments.max_ms < 500 || segments.max_ms > 10000)
    problems.push_back("voice: max_ms must lie in [500, 10000]");
  if (segments.end_ms < 150 || segments.end_in_noise_ms < segments.end_ms ||
      segments.end_in_noise_ms > 1000)
    problems.push_back("voice: end_ms and end_in_noise_ms must lie in [150, 1000], in this order");
  return problems;
}

CommandSpotter::CommandSpotter(const SpotterOptions& options)
    : options_(options), segmenter_(options.segments) {}

Result<std::unique_ptr<CommandSpotter>> CommandSpotter::create(const SpotterOptions& options) {
  if (const auto problems = options.check(); !problems.empty()) return Error{joined(problems)};
  std::vector<std::string> phrases;
  // Single words too, whatever counts: a grammar without them takes "save" for "ortho save".
  for (const std::string& command : options.commands) {
    phrases.push_back(options.wake_word + " " + command);
    phrases.push_back(command);
  }
  auto recognizer = PhraseRecognizer::create(phrases, options.acoustic_model);
  if (!recognizer) return recognizer.error();
  std::unique_ptr<CommandSpotter> spotter(new CommandSpotter(options));
  spotter->recognizer_ = std::move(*recognizer);
  return spotter;
}

void CommandSpotter::push(std::span<const std::int16_t> samples,
                          std::vector<SpokenCommand>& commands) {
  segments_.clear();
  segmenter_.push(samples, segments_);
  for (const SpeechSegment& segment : segments_) {
    if (!segment.ended)
      candidate_ = judge(segment);
    else if (const auto command = std::exchange(candidate_, std::nullopt); command)
      commands.push_back(*command);
  }
}

std::optional<SpokenCommand> CommandSpotter::judge(const SpeechSegment& segment) {
  const Recognition heard =
      recognizer_->recognize(cleaned(segment.samples, kBackgroundSamples, options_.cleaner));
  SpokenCommand spoken{"", 0.0, segment.begin, segment.end};
  std::optional<double> wake_evidence;
  double evidence = 0.0;
  int frames = 0;
  for (const RecognizedWord& word : heard.words) {
    if (word.word == options_.wake_word) {
      wake_evidence = word.evidence;
      continue;
    }
    spoken.text += (spoken.text.empty() ? "" : " ") + word.word;
    evidence += word.frames * word.evidence;
    frames += word.frames;
  }
  if (frames == 0 || heard.evidence_around < options_.least_evidence_around) return std::nullopt;
  spoken.confidence =
      confidence_of(spoken.text, evidence / frames, wake_evidence, segment.above_background_db);
  if (spoken.confidence < kHardlyLikely) return std::nullopt;
  return spoken;
}

double CommandSpotter::confidence_of(const std::string& command, double evidence,
                                     std::optional<double> wake_evidence,
                                     double above_background_db) const {
  const auto own = options_.least_evidence.find(command);
  const double least =
      own == options_.least_evidence.end() ? options_.least_evidence_of_others : own->second;
  const double noisy = noisiness(above_background_db);
  const double least_to_wake = std::lerp(options_.least_evidence_of_wake_word,
                                         options_.least_evidence_of_wake_word_in_noise, noisy) +
                               (command == "delete" ? options_.more_wake_evidence_to_delete : 0.0);
  const double above = wake_evidence ? std::min(evidence - least, *wake_evidence - least_to_wake)
                                     : evidence - least - options_.more_evidence_alone;
  // One half at the least evidence, 0.88 one unit above it.
  const double confidence = 1.0 / (1.0 + std::exp(-2.0 * above));
  const bool quiet = above_background_db >= options_.quiet_above_db;
  const bool counts = wake_evidence || options_.waking == Waking::kNever ||
                      (options_.waking == Waking::kInNoise && quiet);
  // It was heard, and is not acted upon: the status line says so.
  return counts ? confidence : std::min(confidence, 0.49);
}

}  // namespace orthonav::desktop
