#pragma once

#include <string>

namespace orthonav::tools {

/// The version and, if built from a repository, the commit: "0.9.0+1a2b3c4d5e6f", with "-dirty" if
/// files had been changed when it was configured. Results of different builds belong to different
/// studies.
[[nodiscard]] std::string build_name();

}  // namespace orthonav::tools
