#pragma once

#include <string>

#include "engine/case/case_file.h"

namespace orthonav::tools {

/// The case in that folder, checked; the built-in phantom where none is named.
Result<engine::Case> load_checked_case(const std::string& folder,
                                       engine::CaseUse use = engine::CaseUse::kOperation);

}  // namespace orthonav::tools
