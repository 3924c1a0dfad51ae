#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace orthonav::engine {

/// JSON as the text of a script element. A name must not end that element ("</script>"), nor keep
/// it from ending ("<!--<script>"): every "<" is written as an escape.
[[nodiscard]] std::string script_json(const nlohmann::json& value);

}  // namespace orthonav::engine
