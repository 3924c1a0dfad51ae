#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace orthonav::voice {

/// How a segment is made to sound like the acoustic model's training data.
struct CleanerOptions {
  double over_subtraction = 1.5;  ///< times the background's power
  double least_gain = 0.1;        ///< of any frequency, to avoid ringing in gaps
  double speech_rms = 3000.0;     ///< of the loudest frames
  double masking_db = -30.0;  ///< level of the white noise that is added, relative to the speech
};

/// Removes the background from a segment (Wiener filter with the spectrum of the segment's first
/// `background_samples`), brings the speech to a fixed loudness and adds white noise: the model was
/// trained on speech in rooms, and digital silence between words is farther from that than noise.
/// The result begins where the background's samples end, since a recogniser takes a long silence
/// for sounds. The same samples give the same result.
[[nodiscard]] std::vector<std::int16_t> cleaned(std::span<const std::int16_t> samples,
                                                std::size_t background_samples,
                                                const CleanerOptions& options = {});
/// The length of a segment's margin that holds background only.
inline constexpr std::size_t kBackgroundSamples = 16000 * 3 / 10;

}  // namespace orthonav::voice
