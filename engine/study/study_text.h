#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace orthonav::engine {

/// The JSON of a study (docs/file-formats.md). `planned`: how many runs there were to be; more than
/// there are where it was stopped.
[[nodiscard]] std::string study_text(const std::string& method, const nlohmann::ordered_json& runs,
                                     const nlohmann::ordered_json& failed, std::size_t planned);

/// JSON as a study's file writes it: indented by one space.
[[nodiscard]] std::string text_of(const nlohmann::ordered_json& part);

}  // namespace orthonav::engine
