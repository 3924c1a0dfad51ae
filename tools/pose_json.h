#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>

namespace orthonav::tools {

/// A pose by rows in metres as files have it: a list of four rows, in millimetres.
[[nodiscard]] nlohmann::ordered_json rows_mm(std::array<double, 16> row_major);

}  // namespace orthonav::tools
