#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tests/support/noisy_speech.h"

namespace orthonav::bench {

struct PhraseInRoom {
  std::vector<std::int16_t> sound;
  std::int64_t end = 0;  ///< of the phrase, in samples
};

/// A phrase with background noise, after a second and a half of the noise alone.
inline PhraseInRoom phrase_in_room(std::span<const std::int16_t> said, test::Noise noise,
                                   double snr_db, Random& random, test::Babble babble) {
  test::Soundtrack track;
  track.silence(1.5);
  const std::int64_t end = track.speech(said).second;
  track.silence(0.6);
  return {track.with_noise(noise, snr_db, random, babble), end};
}

}  // namespace orthonav::bench
