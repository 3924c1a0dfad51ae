#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace orthonav::engine {

/// JSON as the text of a script element: "</script>" inside a name must not end it.
[[nodiscard]] std::string script_json(const nlohmann::json& value);

}  // namespace orthonav::engine
