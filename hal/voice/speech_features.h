#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

struct fe_s;

namespace orthonav::voice {

/// PocketSphinx's features of 10 ms of sound.
using Cepstrum = std::array<float, 13>;

/// From cleaned samples at `kSpeechRateHz`, by PocketSphinx's front end; empty if there are too
/// few.
[[nodiscard]] std::vector<Cepstrum> cepstra_of(fe_s* front_end,
                                               std::span<const std::int16_t> samples);

}  // namespace orthonav::voice
