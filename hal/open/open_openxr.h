#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "hal/open/open.h"

namespace orthonav {

/// Opens `openxr:[?rig=FILE][+URI]`, where URI is the headset whose cameras it uses; without it,
/// those of the simulated room. An Error says in one line what is wrong.
Result<OpenedHeadset> open_openxr(const std::string& uri, std::string_view rest,
                                  const OpenOptions& options);

}  // namespace orthonav
