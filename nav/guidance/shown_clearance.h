#pragma once

#include <optional>

#include "nav/guidance/clearance_spread.h"

namespace orthonav::nav {

/// Which whole number of tenths stands for a measured one of which more is better: the counterpart
/// of `SteadyNumber`, signed and without its zero. Rounded down; a smaller one is shown at once, a
/// larger one only when the measured one has risen by another tenth. Never above what is measured,
/// nor below it by two tenths.
class SteadyLeast {
 public:
  /// Finite.
  int show(double tenths);
  void forget() { shown_.reset(); }

 private:
  std::optional<int> shown_;
};

/// A screw's clearance as the surgeon reads it, in tenths of a millimetre.
struct ShownClearance {
  int least_tenths = 0;
  /// With 95 % probability it is above that; absent: not known.
  std::optional<int> lower_95_tenths;
  const char* towards = "";  ///< `direction_of` the nearest wall

  /// The screw breaks through, or may: where nothing is known, nobody can rule it out, but it is
  /// not said of every screw.
  [[nodiscard]] bool may_break() const {
    return least_tenths < 0 || (lower_95_tenths && *lower_95_tenths < 0);
  }
};

/// Pair after pair.
class ClearanceWriter {
 public:
  [[nodiscard]] ShownClearance write(const ScrewClearance& measured, Side side);
  void forget() { *this = {}; }

 private:
  SteadyLeast least_;
  SteadyLeast lower_95_;
};

}  // namespace orthonav::nav
