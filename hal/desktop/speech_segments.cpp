#include "hal/desktop/speech_segments.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace orthonav::desktop {

namespace {

constexpr int kFrameMs = 10;
constexpr std::size_t kFrameSamples = kSpeechRateHz / 1000 * kFrameMs;
constexpr double kSilenceDb = -80.0;
// Over 50 ms: the pitch and the babble of a room are evened out, a syllable is not.
constexpr double kSmoothing = 0.3;
// The background is the mean level while nobody speaks, over a third of a second; and never less
// than the least level of the last second.
constexpr double kFollow = 0.03;
constexpr int kFramesOfLeast = 50;
// What stays within so much for half a second is no voice but a noise that began: the background.
constexpr std::size_t kSteadyFrames = 50;
constexpr double kSteadyDb = 6.0;

// How far the loudest syllable stands out of a quiet and of a noisy room.
constexpr double kQuietDb = 35.0;
constexpr double kNoisyDb = 20.0;
// How long before its end a segment is told of.
constexpr int kForewarningMs = 100;

std::size_t samples_of(int ms) { return static_cast<std::size_t>(kSpeechRateHz / 1000 * ms); }

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

SpeechSegmenter::SpeechSegmenter(const SegmentOptions& options)
    : options_(options),
      low_pass_(Biquad::low_pass(3500.0)),
      high_pass_(Biquad::high_pass(200.0)) {}

void SpeechSegmenter::push(std::span<const std::int16_t> samples,
                           std::vector<SpeechSegment>& segments) {
  for (const std::int16_t sample : samples) {
    kept_.push_back(sample);
    const double heard = high_pass_.next(low_pass_.next(sample / 32768.0));
    frame_energy_ += heard * heard;
    ++taken_;
    if (++in_frame_ == kFrameSamples) end_frame(segments);
  }
}

void SpeechSegmenter::follow_background(double level_db, bool loud) {
  if (!background_db_)
    background_db_ = level_db;
  else if (!(loud || speaking_) || level_db < *background_db_)
    *background_db_ += kFollow * (std::min(level_db, *background_db_ + 6.0) - *background_db_);
  recent_db_.push_back(level_db);
  if (recent_db_.size() > kSteadyFrames) recent_db_.erase(recent_db_.begin());
  const auto [low, high] = std::minmax_element(recent_db_.begin(), recent_db_.end());
  if (recent_db_.size() == kSteadyFrames && *high - *low < kSteadyDb)
    background_db_ = std::max(*background_db_, *low);
  // Whoever speaks pauses; what does not is a fan that was switched on.
  least_db_ = std::min(least_db_, level_db);
  if (++frames_of_least_ < kFramesOfLeast) return;
  const double before_db = std::exchange(previous_least_db_, std::exchange(least_db_, 0.0));
  background_db_ = std::max(*background_db_, std::min(before_db, previous_least_db_));
  frames_of_least_ = 0;
}

void SpeechSegmenter::end_frame(std::vector<SpeechSegment>& segments) {
  const double energy = frame_energy_ / static_cast<double>(kFrameSamples);
  smooth_energy_ += kSmoothing * (energy - smooth_energy_);
  const double level_db = std::max(kSilenceDb, 10.0 * std::log10(smooth_energy_ + 1e-12));
  in_frame_ = 0;
  frame_energy_ = 0.0;
  const double above_db = background_db_ ? level_db - *background_db_ : 0.0;
  // A word's last sound dies away; in a silent room what is left of it is still above the silence.
  const bool loud = above_db > options_.above_background_db &&
                    (!speaking_ || above_db > loudest_db_ - options_.below_loudest_db);
  follow_background(level_db, loud);
  if (!speaking_) {
    loud_frames_ = loud ? loud_frames_ + 1 : 0;
    if (loud_frames_ * kFrameMs >= options_.begin_ms) {
      speaking_ = true;
      too_long_ = false;
      quiet_frames_ = 0;
      begin_ = taken_ - loud_frames_ * static_cast<std::int64_t>(kFrameSamples);
      isolated_ =
          begin_ - last_loud_ >= static_cast<std::int64_t>(samples_of(options_.quiet_before_ms));
      last_loud_ = taken_;
      loudest_db_ = above_db;
    }
    forget();
    return;
  }
  if (loud) last_loud_ = taken_;
  loudest_db_ = std::max(loudest_db_, above_db);
  quiet_frames_ = loud ? 0 : quiet_frames_ + 1;
  if (taken_ - begin_ > static_cast<std::int64_t>(samples_of(options_.max_ms))) too_long_ = true;
  const int end_ms = end_now_ms();
  const bool counts = !too_long_ && isolated_;
  if (counts && quiet_frames_ * kFrameMs == end_ms - kForewarningMs)
    segments.push_back({kept_, begin_, last_loud_, loudest_db_, false});
  if (quiet_frames_ * kFrameMs >= end_ms) {
    if (counts) segments.push_back({{}, begin_, last_loud_, loudest_db_, true});
    speaking_ = false;
    loud_frames_ = 0;
  }
  forget();
}

int SpeechSegmenter::end_now_ms() const {
  const double end_ms =
      std::lerp(static_cast<double>(options_.end_ms), static_cast<double>(options_.end_in_noise_ms),
                noisiness(loudest_db_));
  return kFrameMs * static_cast<int>(std::lround(end_ms / kFrameMs));
}

/// Keeps what a segment needs: its margin and itself.
void SpeechSegmenter::forget() {
  std::size_t keep = samples_of(options_.margin_ms + options_.begin_ms);
  if (speaking_ && !too_long_)
    keep = static_cast<std::size_t>(taken_ - begin_) + samples_of(options_.margin_ms);
  if (kept_.size() > keep)
    kept_.erase(kept_.begin(), kept_.end() - static_cast<std::ptrdiff_t>(keep));
}

}  // namespace orthonav::desktop
