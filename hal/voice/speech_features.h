#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

struct fe_s;

namespace orthonav::voice {

/// What PocketSphinx hears of 10 ms of sound.
using Cepstrum = std::array<float, 13>;

/// Of cleaned samples at `kSpeechRateHz`, by PocketSphinx's front end; empty where they are too
/// few. Their zero is fixed: the mean of one word says more about the word than about the
/// microphone, and the means were adapted to microphones that differ.
[[nodiscard]] std::vector<Cepstrum> cepstra_of(fe_s* front_end,
                                               std::span<const std::int16_t> samples);

}  // namespace orthonav::voice
