#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "base/result.h"

namespace orthonav::engine {

/// A study's JSON from any source: a method, and runs that each have case, seed and levels. Refuses
/// anything else in one line; `name` stands for it in the message.
Result<nlohmann::ordered_json> parse_study(const std::string& text, const std::string& name);

}  // namespace orthonav::engine
