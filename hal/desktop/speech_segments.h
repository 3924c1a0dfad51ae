#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace orthonav::desktop {

/// What speech is recognised from: one channel at this rate, as the acoustic model was trained.
inline constexpr int kSpeechRateHz = 16000;

/// When sound counts as speech. Levels are those of 50 ms of sound between 200 and 3500 Hz.
struct SegmentOptions {
  double above_background_db = 8.0;  ///< louder than the background by so much
  double below_loudest_db = 30.0;    ///< and no more below the segment's loudest than so much
  int begin_ms = 50;                 ///< loud for so long begins a segment
  /// Quiet for so long ends it. In noise the last sounds of a word can't be told from the
  /// background, and what is left of it seems to end sooner than it does.
  int end_ms = 240;
  int end_in_noise_ms = 380;
  int quiet_before_ms = 500;  ///< a command follows such a pause; a sentence's word does not
  int margin_ms = 400;        ///< kept before what was loud
  int max_ms = 1900;          ///< speech that goes on for longer is no command
};

/// A stretch of sound between two silences.
struct SpeechSegment {
  std::vector<std::int16_t> samples;  ///< with the margins
  std::int64_t begin = 0;             ///< the first loud sample, counted since the stream began
  std::int64_t end = 0;               ///< one past the last loud sample
  double above_background_db = 0.0;   ///< the loudest 50 ms
  /// Whether it is over. A segment that may be over soon is told of before, with all its samples,
  /// so that it can be recognised while one waits; it then ends as it was, or goes on.
  bool ended = false;
};

/// How noisy a room is in which a voice stands out by so much: 0 from 35 dB on, 1 below 20 dB.
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

/// Cuts a stream of sound into stretches of speech by its level above the background, which is
/// followed as it changes. Bounded memory: what goes on for longer than a command is dropped as it
/// comes.
class SpeechSegmenter {
 public:
  explicit SpeechSegmenter(const SegmentOptions& options = {});
  /// Takes samples at `kSpeechRateHz` and appends the segments that ended in them.
  void push(std::span<const std::int16_t> samples, std::vector<SpeechSegment>& segments);

 private:
  SegmentOptions options_;
  std::vector<std::int16_t> kept_;  ///< the newest sound, of a segment all of it
  std::int64_t taken_ = 0;          ///< samples since the stream began
  std::size_t in_frame_ = 0;        ///< samples of the frame that is not complete yet
  double frame_energy_ = 0.0;
  Biquad low_pass_;
  Biquad high_pass_;
  double smooth_energy_ = 0.0;
  std::optional<double> background_db_;
  double least_db_ = 0.0;             ///< since the last half second began
  double previous_least_db_ = -80.0;  ///< in those before
  int frames_of_least_ = 0;
  std::vector<double> recent_db_;  ///< of the last half second
  int loud_frames_ = 0;            ///< in a row, before a segment
  int quiet_frames_ = 0;           ///< in a row, within one
  bool speaking_ = false;
  double loudest_db_ = 0.0;  ///< of the segment, above its background
  bool too_long_ = false;
  bool isolated_ = false;
  std::int64_t begin_ = 0;
  std::int64_t last_loud_ = 0;

  void end_frame(std::vector<SpeechSegment>& segments);
  void follow_background(double level_db, bool loud);
  [[nodiscard]] int end_now_ms() const;
  void forget();
};

}  // namespace orthonav::desktop
