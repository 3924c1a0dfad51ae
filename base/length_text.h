#pragma once

#include <string>

namespace orthonav {

/// A length for messages and readouts: "1.2 mm".
[[nodiscard]] std::string in_mm(double length_m, int decimals = 1);

}  // namespace orthonav
