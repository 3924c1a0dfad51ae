#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "base/random.h"
#include "engine/session/workflow/commands.h"
#include "tests/support/noisy_speech.h"

namespace orthonav::voice::voice_test {

inline const std::vector<std::string> kCommands = engine::spotted_phrases();

inline std::vector<std::int16_t> said(const std::string& text) {
  const auto samples = orthonav::test::spoken(text, {"en-us", 150});
  EXPECT_TRUE(samples.ok());
  return samples ? *samples : std::vector<std::int16_t>();
}

/// Each text after a second of silence, with hardly any noise.
inline std::vector<std::int16_t> quiet_room(const std::vector<std::string>& texts) {
  orthonav::test::Soundtrack sound;
  sound.silence(1.0);
  for (const std::string& text : texts) {
    sound.speech(said(text));
    sound.silence(1.0);
  }
  Random random(5);
  return sound.with_noise(orthonav::test::Noise::kPink, 50.0, random);
}

}  // namespace orthonav::voice::voice_test
