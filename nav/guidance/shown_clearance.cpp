#include "nav/guidance/shown_clearance.h"

#include <algorithm>
#include <cmath>

namespace orthonav::nav {
namespace {

constexpr double kTenths_per_m = 1e4;
constexpr double kMaxTenths = 9999.0;
/// 1.2 mm is 12 tenths, regardless of the last bits.
constexpr double kLastBitsOfTenths = 1e-6;
/// Towards the safe side.
constexpr double kBandOfTenths = 1.0;

}  // namespace

int SteadyLeast::show(double tenths) {
  const double within = std::clamp(tenths, -kMaxTenths, kMaxTenths);
  int digits = static_cast<int>(std::floor(within + kLastBitsOfTenths));
  if (shown_ && *shown_ <= digits && within < *shown_ + 1 + kBandOfTenths) {
    digits = *shown_;
  }
  shown_ = digits;
  return digits;
}

ShownClearance ClearanceWriter::write(const ScrewClearance& measured, Side side) {
  ShownClearance out;
  out.least_tenths = least_.show(kTenths_per_m * measured.least.clearance_m);
  out.towards = direction_of(measured.least, side);
  if (measured.spread) {
    out.lower_95_tenths = lower_95_.show(kTenths_per_m * measured.spread->lower_95_m);
  } else {
    lower_95_.forget();
  }
  return out;
}

}  // namespace orthonav::nav
