#pragma once

#include <string>

#include "hal/api/connection_statistics.h"

namespace orthonav::tools {

/// How a connection did, in lines.
[[nodiscard]] std::string connection_report(const ConnectionStatistics& statistics);

}  // namespace orthonav::tools
