#pragma once

#include <memory>

#include "hal/api/devices.h"
#include "hal/api/microphone.h"
#include "hal/voice/command_spotter.h"

namespace orthonav::voice {

/// Where the sound is processed.
enum class Listening {
  kOnItsOwnThread,  ///< for a microphone: `poll` only takes the results
  kInPoll           ///< for a recorded sound: the same commands at the same times in every run
};

/// Spots commands in a microphone's sound. A phrase's time is when it began to be spoken; it
/// arrives about 0.3 s after its end. If its own thread hangs for more than 0.4 s of `wall` (null:
/// this machine's time), `poll` fails with `ErrorCode::kUnavailable`.
[[nodiscard]] Result<std::unique_ptr<Voice>> open_spotted_voice(
    std::unique_ptr<Microphone> microphone, const SpotterOptions& options, Listening listening,
    std::unique_ptr<const Clock> wall = nullptr);

}  // namespace orthonav::voice
