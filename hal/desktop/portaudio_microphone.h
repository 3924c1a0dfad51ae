#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hal/api/microphone.h"

namespace orthonav::desktop {

/// Names of the machine's microphones, the default one first.
[[nodiscard]] std::vector<std::string> microphone_names();

/// The first microphone whose name contains `name`, the default one for an empty name. Borrows the
/// headset's clock. If none matches, the Error lists the available names.
[[nodiscard]] Result<std::unique_ptr<Microphone>> open_portaudio_microphone(const std::string& name,
                                                                            const Clock& clock);

}  // namespace orthonav::desktop
