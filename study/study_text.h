#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace orthonav::engine {

/// The JSON of a study (docs/file-formats.md). `planned`: the number of planned runs; larger than
/// the actual number if it was stopped.
[[nodiscard]] std::string study_text(const std::string& method, const nlohmann::ordered_json& runs,
                                     const nlohmann::ordered_json& failed, std::size_t planned);

/// The figures of a study's JSON as a table for a terminal, beside the published ones.
[[nodiscard]] std::string study_table(const std::string& study_text);

/// JSON in the format of a study's file: indented by one space.
[[nodiscard]] std::string text_of(const nlohmann::ordered_json& part);

}  // namespace orthonav::engine
