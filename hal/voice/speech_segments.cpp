#include "hal/voice/speech_segments.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace orthonav::voice {

namespace {

// When sound counts as speech. Levels are those of 50 ms of sound between 200 and 3500 Hz.
/// A segment is the sound above a threshold that lies at least this far above the background: the
/// lowest threshold at which, for a while before and after it, no other sound exceeds it.
constexpr double kLeastAboveBackground_db = 6.0;
constexpr double kMaxAboveBackground_db = 14.0;
constexpr double kAboveThreshold_db = 6.0;  ///< the least level of its loudest part
constexpr double kBelowLoudest_db =
    30.0;  ///< the highest threshold, since a word's last sound fades away
constexpr int kLeast_ms = 200;
/// Quiet of this length ends it. In noise the last sounds of a word can't be distinguished from
/// the background, so the word seems to end early.
constexpr int kEnd_ms = 240;
constexpr int kEndInNoise_ms = 300;
constexpr int kQuietBefore_ms = 500;  ///< pause before a command; a word within a sentence has none
constexpr int kMargin_ms = 400;       ///< kept before the loud part
constexpr int kMax_ms = 1900;         ///< longer speech is not a command
constexpr int kFrameMs = 10;
constexpr std::size_t kFrameSamples = kSpeechRateHz / 1000 * kFrameMs;
constexpr double kSilenceDb = -80.0;
// Averages over 50 ms: this evens out the pitch and the babble of a room, but not a syllable.
constexpr double kSmoothing = 0.3;
// The background is the median level of this many frames.
constexpr std::int64_t kHistoryFrames = 600;
// Even continuous speech has pauses, though: the background is at most this far above the level
// that a tenth of these frames stay below (or a tenth of the newest frames, if a noise began).
constexpr std::int64_t kShortFrames = 150;
constexpr double kPauses = 0.1;
constexpr double kAbovePausesDb = 3.0;
constexpr double kThresholdStepDb = 1.0;
// For each step above the lowest threshold, more quiet must follow a stretch, since a word's weaker
// sounds may lie below it; only slightly more if even sounds this much below the loudest one lie
// above it.
constexpr int kMoreQuietFrames = 9;
constexpr int kLittleMoreQuietFrames = 5;
constexpr double kFaintDb = 14.0;
// Sound that is this much quieter than the next segment does not count as speech before it.
constexpr double kBesideDb = 8.0;

// How far the loudest syllable stands out in a quiet and in a noisy room.
constexpr double kQuietDb = 35.0;
constexpr double kNoisyDb = 20.0;
// How long before its end a segment is announced.
constexpr int kForewarningFrames = 10;
// How long the quiet after a segment may last beyond the quiet that ends one in noise.
constexpr int kRecentFrames = kMoreQuietFrames * 10;

std::size_t samples_of(int ms) { return static_cast<std::size_t>(kSpeechRateHz / 1000 * ms); }
std::int64_t samples_of_frames(std::int64_t frames) {
  return frames * static_cast<std::int64_t>(kFrameSamples);
}

std::size_t bin_of(double level_db) {
  return static_cast<std::size_t>(std::clamp(level_db, kSilenceDb, 0.0) - kSilenceDb);
}

}  // namespace

double noisiness(double above_background_db) {
  return std::clamp((kQuietDb - above_background_db) / (kQuietDb - kNoisyDb), 0.0, 1.0);
}

Biquad Biquad::low_pass(double corner_hz) {
  const double w = 2.0 * std::numbers::pi * corner_hz / kSpeechRateHz;
  const double alpha = std::sin(w) / std::numbers::sqrt2;
  const double a0 = 1.0 + alpha;
  Biquad filter;
  filter.b1_ = (1.0 - std::cos(w)) / a0;
  filter.b0_ = filter.b2_ = 0.5 * filter.b1_;
  filter.a1_ = -2.0 * std::cos(w) / a0;
  filter.a2_ = (1.0 - alpha) / a0;
  return filter;
}

Biquad Biquad::high_pass(double corner_hz) {
  Biquad filter = low_pass(corner_hz);
  const double w = 2.0 * std::numbers::pi * corner_hz / kSpeechRateHz;
  const double a0 = 1.0 + std::sin(w) / std::numbers::sqrt2;
  filter.b1_ = -(1.0 + std::cos(w)) / a0;
  filter.b0_ = filter.b2_ = -0.5 * filter.b1_;
  return filter;
}

double Biquad::next(double x) {
  const double y = b0_ * x + b1_ * x1_ + b2_ * x2_ - a1_ * y1_ - a2_ * y2_;
  x2_ = std::exchange(x1_, x);
  y2_ = std::exchange(y1_, y);
  return y;
}

LevelHistogram::LevelHistogram() : counts_(static_cast<std::size_t>(-kSilenceDb) + 1) {}

void LevelHistogram::add(double level_db) {
  ++counts_[bin_of(level_db)];
  ++frames_;
}

void LevelHistogram::remove(double level_db) {
  --counts_[bin_of(level_db)];
  --frames_;
}

double LevelHistogram::level_above(double fraction) const {
  std::size_t bin = 0;
  for (int below = counts_[0]; below < fraction * frames_; below += counts_[bin]) {
    ++bin;
  }
  return kSilenceDb + static_cast<double>(bin) + 0.5;
}

SpeechSegmenter::SpeechSegmenter()
    : low_pass_(Biquad::low_pass(3500.0)),
      high_pass_(Biquad::high_pass(200.0)),
      levels_db_(static_cast<std::size_t>(kHistoryFrames)) {}

void SpeechSegmenter::push(std::span<const std::int16_t> samples,
                           std::vector<SpeechSegment>& segments) {
  for (const std::int16_t sample : samples) {
    kept_.push_back(sample);
    const double heard = high_pass_.next(low_pass_.next(sample / 32768.0));
    frame_energy_ += heard * heard;
    if (++in_frame_ == kFrameSamples) {
      end_frame(segments);
    }
  }
}

void SpeechSegmenter::keep_level(double level_db) {
  if (frames_ >= kHistoryFrames) {
    long_.remove(this->level_db(frames_));
  }
  if (frames_ >= kShortFrames) {
    short_.remove(this->level_db(frames_ - kShortFrames));
  }
  levels_db_[static_cast<std::size_t>(frames_ % kHistoryFrames)] = static_cast<float>(level_db);
  // In the stored form, so that it can be removed again.
  long_.add(this->level_db(frames_));
  short_.add(this->level_db(frames_));
  ++frames_;
}

double SpeechSegmenter::level_db(std::int64_t frame) const {
  return levels_db_[static_cast<std::size_t>(frame % kHistoryFrames)];
}

double SpeechSegmenter::background_db() const {
  const double pauses_db = std::max(long_.level_above(kPauses), short_.level_above(kPauses));
  return std::min(long_.level_above(0.5), pauses_db + kAbovePausesDb);
}

int SpeechSegmenter::quiet_frames(double above_background_db) const {
  const double end_ms = std::lerp(static_cast<double>(kEnd_ms), static_cast<double>(kEndInNoise_ms),
                                  noisiness(above_background_db));
  return static_cast<int>(std::lround(end_ms / kFrameMs));
}

/// The newest stretch of frames above a threshold: pauses within it are shorter than the one before
/// it. Nothing if it is too long.
std::optional<SpeechSegmenter::Stretch> SpeechSegmenter::stretch_above(double threshold_db) const {
  const std::int64_t oldest = std::max<std::int64_t>(0, frames_ - kHistoryFrames);
  const std::int64_t pause = kQuietBefore_ms / kFrameMs;
  std::int64_t at = frames_ - 1;
  while (at >= oldest && level_db(at) <= threshold_db) {
    --at;
  }
  Stretch stretch{at, at + 1, threshold_db, kSilenceDb};
  for (; at >= oldest && at >= stretch.begin - pause; --at) {
    if (level_db(at) <= threshold_db) {
      continue;
    }
    stretch.loudest_db = std::max(stretch.loudest_db, level_db(at));
    stretch.begin = at;
    if ((stretch.end - stretch.begin) * kFrameMs > kMax_ms) {
      return std::nullopt;
    }
  }
  // The time before the stream counts as silent.
  if (at < oldest && oldest > 0) {
    return std::nullopt;
  }
  return stretch;
}

/// Whether speech outside the stretch precedes it so closely that the stretch does not stand alone.
bool SpeechSegmenter::follows_speech(const Stretch& stretch) const {
  if (stretch.begin < over_.end) {
    return true;
  }
  return (stretch.begin - over_.end) * kFrameMs < kQuietBefore_ms &&
         over_.loudest_db > stretch.loudest_db - kBesideDb;
}

std::optional<SpeechSegmenter::Stretch> SpeechSegmenter::find(double background_db) const {
  double loudest_db = kSilenceDb;
  const std::int64_t recent = (kMax_ms + kEndInNoise_ms) / kFrameMs + kRecentFrames;
  for (std::int64_t at = std::max<std::int64_t>(0, frames_ - recent); at < frames_; ++at) {
    loudest_db = std::max(loudest_db, level_db(at));
  }
  const double least_db =
      std::max(background_db + kLeastAboveBackground_db, loudest_db - kBelowLoudest_db);
  const double most_db = std::max(
      least_db, std::min(background_db + kMaxAboveBackground_db, loudest_db - kAboveThreshold_db));
  int quiet = quiet_frames(loudest_db - background_db);
  for (double threshold_db = least_db; threshold_db <= most_db; threshold_db += kThresholdStepDb) {
    auto stretch = stretch_above(threshold_db);
    if (!stretch || stretch->loudest_db < threshold_db + kAboveThreshold_db) {
      continue;
    }
    stretch->quiet_frames = std::exchange(
        quiet,
        quiet + (threshold_db < loudest_db - kFaintDb ? kLittleMoreQuietFrames : kMoreQuietFrames));
    const bool told = frames_ - stretch->end >= stretch->quiet_frames - kForewarningFrames;
    const bool long_enough = (stretch->end - stretch->begin) * kFrameMs >= kLeast_ms;
    if (!told || !long_enough || follows_speech(*stretch)) {
      continue;
    }
    stretch->above_background_db = stretch->loudest_db - background_db;
    return stretch;
  }
  return std::nullopt;
}

void SpeechSegmenter::end_frame(std::vector<SpeechSegment>& segments) {
  const double energy = frame_energy_ / static_cast<double>(kFrameSamples);
  smooth_energy_ += kSmoothing * (energy - smooth_energy_);
  keep_level(std::max(kSilenceDb, 10.0 * std::log10(smooth_energy_ + 1e-12)));
  in_frame_ = 0;
  frame_energy_ = 0.0;
  if (waiting_ && level_db(frames_ - 1) > waiting_->threshold_db) {
    waiting_.reset();
  }
  if (!waiting_) {
    waiting_ = find(background_db());
    if (waiting_) {
      segments.push_back(segment_of(*waiting_, false));
    }
  }
  if (waiting_ && frames_ - waiting_->end >= waiting_->quiet_frames) {
    segments.push_back(segment_of(*waiting_, true));
    over_ = *std::exchange(waiting_, std::nullopt);
  }
  forget();
}

SpeechSegment SpeechSegmenter::segment_of(const Stretch& stretch, bool ended) const {
  SpeechSegment segment{{},
                        samples_of_frames(stretch.begin),
                        samples_of_frames(stretch.end),
                        stretch.above_background_db,
                        ended};
  if (ended) {
    return segment;
  }
  const std::int64_t length = std::min(samples_of_frames(frames_ - stretch.begin) +
                                           static_cast<std::int64_t>(samples_of(kMargin_ms)),
                                       static_cast<std::int64_t>(kept_.size()));
  segment.samples.assign(kept_.end() - length, kept_.end());
  return segment;
}

/// Keeps what the longest segment needs, with its margin and the quiet that ends it.
void SpeechSegmenter::forget() {
  const std::size_t keep = samples_of(kMargin_ms + kMax_ms + kEndInNoise_ms) +
                           static_cast<std::size_t>(kRecentFrames) * kFrameSamples;
  if (kept_.size() > 2 * keep) {
    kept_.erase(kept_.begin(), kept_.end() - static_cast<std::ptrdiff_t>(keep));
  }
}

}  // namespace orthonav::voice
