#pragma once

#include <string>

#include "hal/api/connection_statistics.h"

namespace orthonav::tools {

/// How well a connection worked, in lines of text.
[[nodiscard]] std::string connection_report(const ConnectionStatistics& statistics);

}  // namespace orthonav::tools
