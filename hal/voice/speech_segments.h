#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace orthonav::voice {

/// Sampling rate for speech recognition, one channel: that of the acoustic model's training.
inline constexpr int kSpeechRateHz = 16000;

/// A stretch of sound between two silences.
struct SpeechSegment {
  std::vector<std::int16_t> samples;  ///< including the margins
  std::int64_t begin = 0;             ///< the first loud sample, counted since the stream began
  std::int64_t end = 0;               ///< one past the last loud sample
  double above_background_db = 0.0;   ///< of the loudest 50 ms
  /// Whether it is over. A segment that may be over soon is announced in advance, with all its
  /// samples, so that it can be recognised meanwhile; it then ends unchanged or continues.
  bool ended = false;
};

/// How noisy a room is in which a voice stands out by this much: 0 from 35 dB on, 1 below 20 dB.
[[nodiscard]] double noisiness(double above_background_db);

/// A filter of second order; its coefficients are those of R. Bristow-Johnson's "Audio EQ
/// cookbook".
class Biquad {
 public:
  static Biquad low_pass(double corner_hz);
  static Biquad high_pass(double corner_hz);
  double next(double sample);

 private:
  double b0_ = 1.0, b1_ = 0.0, b2_ = 0.0, a1_ = 0.0, a2_ = 0.0;
  double x1_ = 0.0, x2_ = 0.0, y1_ = 0.0, y2_ = 0.0;
};

/// How often each level, in whole decibels, occurred among some frames.
class LevelHistogram {
 public:
  LevelHistogram();
  void add(double level_db);
  void remove(double level_db);
  /// The level below which this fraction of the frames stays.
  [[nodiscard]] double level_above(double fraction) const;

 private:
  std::vector<int> counts_;
  int frames_ = 0;
};

/// Cuts a stream of sound into stretches of speech: sound that stands out from the half second
/// before it and the quarter second or more after it. Those may lie somewhat above the background
/// (the median of the last seconds), which allows for other people's voices. Bounded memory.
class SpeechSegmenter {
 public:
  SpeechSegmenter();
  /// Takes samples at `kSpeechRateHz` and appends the segments that ended in them.
  void push(std::span<const std::int16_t> samples, std::vector<SpeechSegment>& segments);

 private:
  /// Frames, counted since the stream began.
  struct Stretch {
    std::int64_t begin = 0;
    std::int64_t end = 0;  ///< one past the last loud one
    double threshold_db = 0.0;
    double loudest_db = 0.0;
    double above_background_db = 0.0;  ///< of the loudest
    int quiet_frames = 0;              ///< after which it is over
  };
  std::vector<std::int16_t> kept_;  ///< the newest sound
  std::size_t in_frame_ = 0;        ///< samples of the frame that is still incomplete
  double frame_energy_ = 0.0;
  Biquad low_pass_;
  Biquad high_pass_;
  double smooth_energy_ = 0.0;
  std::int64_t frames_ = 0;       ///< since the stream began
  std::vector<float> levels_db_;  ///< of the last frames, as a ring
  LevelHistogram long_;           ///< of these
  LevelHistogram short_;          ///< of the newest of these
  std::optional<Stretch> waiting_;
  Stretch over_;  ///< the last that ended

  void end_frame(std::vector<SpeechSegment>& segments);
  void forget();
  void keep_level(double level_db);
  /// With the sound kept so far, if it has not ended yet.
  [[nodiscard]] SpeechSegment segment_of(const Stretch& stretch, bool ended) const;
  [[nodiscard]] double level_db(std::int64_t frame) const;
  [[nodiscard]] double background_db() const;
  [[nodiscard]] std::optional<Stretch> stretch_above(double threshold_db) const;
  [[nodiscard]] bool follows_speech(const Stretch& stretch) const;
  [[nodiscard]] std::optional<Stretch> find(double background_db) const;
  [[nodiscard]] int quiet_frames(double above_background_db) const;
};

}  // namespace orthonav::voice
