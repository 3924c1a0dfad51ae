#pragma once

#include <optional>

#include "nav/guidance/screw_clearance.h"

namespace orthonav::nav {

/// Decides which whole number of tenths is displayed for a measured number of which more is better:
/// the counterpart of `SteadyNumber`, signed and without its rule for zero. Rounded down; a smaller
/// one is shown at once, a larger one only when the measured number has risen by another tenth.
/// Never above the measured number, and below it by less than two tenths.
class SteadyLeast {
 public:
  /// `tenths` must be finite.
  int show(double tenths);
  void forget() { shown_.reset(); }

 private:
  std::optional<int> shown_;
};

/// A screw's clearance as displayed to the surgeon, in tenths of a millimetre.
struct ShownClearance {
  int least_tenths = 0;
  /// With 95 % probability the clearance is above this; absent: not known.
  std::optional<int> lower_95_tenths;
  const char* towards = "";  ///< `direction_of` the nearest wall

  /// Whether the screw breaks through, or may. If the uncertainty is unknown, a breach can't be
  /// ruled out, but that alone does not count, or every screw would be flagged.
  [[nodiscard]] bool may_break() const {
    return least_tenths < 0 || (lower_95_tenths && *lower_95_tenths < 0);
  }
};

/// Writes the clearance, pair after pair.
class ClearanceWriter {
 public:
  [[nodiscard]] ShownClearance write(const ScrewClearance& measured, Side side);
  void forget() { *this = {}; }

 private:
  SteadyLeast least_;
  SteadyLeast lower_95_;
};

}  // namespace orthonav::nav
