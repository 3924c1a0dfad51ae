#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "tools/orthonav/doctor/machine.h"

namespace orthonav::tools {

/// Which ports of the headset at `uri` (hl2ss://HOST) answer, or the content of a recording
/// (replay:PATH). An Error for any other URI.
[[nodiscard]] Result<std::vector<Offer>> offers_of_headset(const std::string& uri);

}  // namespace orthonav::tools
