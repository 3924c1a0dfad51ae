#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "tools/machine.h"

namespace orthonav::tools {

/// Which ports of the headset at `uri` (hl2ss://HOST) answer, or what a recording (replay:PATH)
/// holds. An Error for another URI.
[[nodiscard]] Result<std::vector<Offer>> offers_of_headset(const std::string& uri);

}  // namespace orthonav::tools
