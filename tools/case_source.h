#pragma once

#include <string>

#include "engine/case/case_file.h"

namespace orthonav::tools {

/// The checked case in that folder; the built-in phantom if none is given.
Result<engine::Case> load_checked_case(const std::string& folder,
                                       engine::CaseUse use = engine::CaseUse::kOperation);

}  // namespace orthonav::tools
