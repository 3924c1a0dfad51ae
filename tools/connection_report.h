#pragma once

#include <string>

#include "hal/hl2ss/statistics.h"

namespace orthonav::tools {

/// How a connection did, in lines.
[[nodiscard]] std::string connection_report(const hl2ss::Statistics& statistics);

}  // namespace orthonav::tools
