#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "base/result.h"

namespace orthonav::engine {

/// A study's JSON, whoever wrote it: a method, and runs of which each has case, seed and levels.
/// Refuses anything else in one line; `name` stands for it there.
Result<nlohmann::ordered_json> parse_study(const std::string& text, const std::string& name);

}  // namespace orthonav::engine
