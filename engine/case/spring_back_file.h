#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "nav/guidance/rod_bender.h"

namespace orthonav::engine {

/// Trial bends of a rod on its bender: CSV with the header `set_deg,kept_deg` (in either order),
/// one trial per line, `#` before a remark. Refuses, with file and line, a value that is not a
/// number; nav::RodSpringBack checks whether the trials form a curve.
Result<std::vector<nav::SpringBackTrial>> load_spring_back(const std::string& path);

}  // namespace orthonav::engine
