#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "nav/guidance/rod_bender.h"

namespace orthonav::engine {

/// Trial bends of a rod on its bender: CSV with the header `set_deg,kept_deg` (in either order),
/// one trial a line, `#` before a remark. Refuses, with file and line, what is no number; whether
/// the trials make a curve is for nav::RodSpringBack.
Result<std::vector<nav::SpringBackTrial>> load_spring_back(const std::string& path);

}  // namespace orthonav::engine
