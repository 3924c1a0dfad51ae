#pragma once

#include <cstddef>
#include <string>

namespace orthonav::engine {

// The status line is written anew after every pair, into strings that keep their room: appending to
// them allocates nothing once the frame loop is warm.

/// "1.2 mm"; "-- mm" for what is not finite.
void append_mm(std::string& out, double length_m, int decimals);
void append_count(std::string& out, std::size_t count);

}  // namespace orthonav::engine
