#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace orthonav::voice {

/// Removes the background from a segment (Wiener filter with the spectrum of the segment's first
/// `background_samples`), brings the speech to a fixed loudness and adds white noise: the model was
/// trained on speech in rooms, and digital silence between words is farther from that than noise.
/// The result begins where the background's samples end, since a recogniser takes a long silence
/// for sounds. The same samples give the same result.
[[nodiscard]] std::vector<std::int16_t> cleaned(std::span<const std::int16_t> samples,
                                                std::size_t background_samples);
/// The length of a segment's margin that holds background only.
inline constexpr std::size_t kBackgroundSamples = 16000 * 3 / 10;

}  // namespace orthonav::voice
