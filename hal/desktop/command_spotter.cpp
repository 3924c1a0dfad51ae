#include "hal/desktop/command_spotter.h"

#include <cmath>

#include "hal/api/joined.h"

namespace orthonav::desktop {

namespace {

constexpr double kHardlyLikely = 0.25;
// The background is estimated from what lies before a segment; then all but a breath of it goes,
// for a recogniser that hears a long silence takes it for sounds.
constexpr std::size_t kBackgroundSamples = kSpeechRateHz * 3 / 10;
constexpr std::size_t kDroppedBefore = kSpeechRateHz * 3 / 10;
constexpr std::size_t kDroppedAfter = kSpeechRateHz / 10;

/// One half at the least evidence, 0.88 one unit above it.
double confidence_of(double evidence, double least) {
  return 1.0 / (1.0 + std::exp(-2.0 * (evidence - least)));
}

}  // namespace

std::vector<std::string> SpotterOptions::check() const {
  std::vector<std::string> problems;
  if (commands.empty()) problems.push_back("voice: no command to listen for");
  bool finite = std::isfinite(least_evidence_of_others);
  for (const auto& [command, least] : least_evidence) finite = finite && std::isfinite(least);
  if (!finite) problems.push_back("voice: least_evidence must be finite");
  if (segments.margin_ms < 400) problems.push_back("voice: margin_ms must be at least 400");
  if (segments.max_ms < 500 || segments.max_ms > 10000)
    problems.push_back("voice: max_ms must lie in [500, 10000]");
  if (segments.end_ms < 100 || segments.end_ms > 1000)
    problems.push_back("voice: end_ms must lie in [100, 1000]");
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
  for (const SpeechSegment& segment : segments_) judge(segment, commands);
}

void CommandSpotter::judge(const SpeechSegment& segment, std::vector<SpokenCommand>& commands) {
  std::vector<std::int16_t> sound = cleaned(segment.samples, kBackgroundSamples, options_.cleaner);
  if (sound.size() <= kDroppedBefore + kDroppedAfter) return;
  sound.erase(sound.begin(), sound.begin() + static_cast<std::ptrdiff_t>(kDroppedBefore));
  sound.resize(sound.size() - kDroppedAfter);
  const auto recognition = recognizer_->recognize(sound);
  if (!recognition) return;
  SpokenCommand spoken{recognition->text, 0.0, segment.begin, segment.end};
  const bool woken = spoken.text.starts_with(options_.wake_word + " ");
  if (woken) spoken.text.erase(0, options_.wake_word.size() + 1);
  const auto own = options_.least_evidence.find(spoken.text);
  const double least =
      own == options_.least_evidence.end() ? options_.least_evidence_of_others : own->second;
  spoken.confidence = confidence_of(recognition->evidence, least);
  const bool quiet = segment.above_background_db >= options_.quiet_above_db;
  const bool counts =
      woken || options_.waking == Waking::kNever || (options_.waking == Waking::kInNoise && quiet);
  // It was heard, and is not acted upon: the status line says so.
  if (!counts) spoken.confidence = std::min(spoken.confidence, 0.49);
  if (spoken.confidence >= kHardlyLikely) commands.push_back(std::move(spoken));
}

}  // namespace orthonav::desktop
