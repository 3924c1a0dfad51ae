#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hal/sim/error_model.h"

namespace orthonav::sim {

/// One number of the error model.
struct Magnitude {
  std::string_view name;  ///< as the member
  std::string_view unit;
  double ErrorModel::*value = nullptr;
  /// Limits beyond which it is refused: far from any real room, the scene leaves the cameras' view
  /// or the surgeon can't finish.
  double lowest = 0.0;
  double highest = 0.0;
  /// The plausible range.
  double low = 0.0;
  double high = 0.0;
  std::string_view source;
};

/// All of them, in the order of the struct.
[[nodiscard]] std::span<const Magnitude> magnitudes();
/// Null for an unknown name.
[[nodiscard]] const Magnitude* magnitude_named(std::string_view name);

}  // namespace orthonav::sim
