#pragma once

#include <string>

namespace orthonav {

/// A length for messages and readouts: "1.2 mm"; never "-0.0 mm".
[[nodiscard]] std::string in_mm(double length_m, int decimals = 1);

/// Appends it; "-- mm" if it is not finite. Allocates nothing if the string has room.
void append_mm(std::string& out, double length_m, int decimals = 1);

/// A length outside its limits, with enough decimals to tell it from the limit it breaks.
[[nodiscard]] std::string in_mm_outside(double length_m, double least_m, double most_m,
                                        int decimals = 1);

}  // namespace orthonav
