#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "base/result.h"
#include "base/vec.h"

namespace orthonav::engine {

/// A vector in metres as written to files: a list of three numbers, in millimetres.
[[nodiscard]] nlohmann::ordered_json vector_mm(Vec3 v_m);

/// A pose by rows in metres as written to files: a list of four rows, in millimetres.
[[nodiscard]] nlohmann::ordered_json rows_mm(std::array<double, 16> row_major);

/// Writes the whole file, one line per value; invalid UTF-8 in texts is replaced.
Status write_json(const std::string& path, const nlohmann::ordered_json& root);

}  // namespace orthonav::engine
