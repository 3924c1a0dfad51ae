#pragma once

#include <filesystem>
#include <memory>

#include "hal/api/microphone.h"

namespace orthonav::desktop {

/// A sound file (anything that libsndfile reads; several channels are averaged) as a microphone
/// that hears it as the clock advances, from the moment of opening. After the file's end there is
/// silence. Borrows the clock. Refuses what is not a sound file, is longer than an hour, or
/// has more than 16 channels.
[[nodiscard]] Result<std::unique_ptr<Microphone>> open_wav_microphone(
    const std::filesystem::path& path, const Clock& clock);

}  // namespace orthonav::desktop
