#pragma once

#include <string>

#include "engine/case/case_file.h"
#include "engine/scan/volume.h"

namespace orthonav::tools {

/// The checked case in that folder; the built-in phantom if none is given.
Result<engine::Case> load_checked_case(const std::string& folder,
                                       engine::CaseUse use = engine::CaseUse::kOperation);

/// A scan or a label map, as `engine::load_volume` reads it; what its reader mended is said on
/// standard error.
Result<engine::Volume> load_scan(const std::string& path, const std::string& series = {});

}  // namespace orthonav::tools
