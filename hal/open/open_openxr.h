#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "hal/open/open.h"

namespace orthonav {

/// `openxr:` and what follows it: `[?rig=FILE][+URI]`, where URI is the headset whose cameras it
/// uses; without one, the simulated room's. An Error names in one line what is wrong.
Result<OpenedHeadset> open_openxr(const std::string& uri, std::string_view rest,
                                  const OpenOptions& options);

}  // namespace orthonav
