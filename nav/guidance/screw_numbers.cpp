#include "nav/guidance/screw_numbers.h"

#include <algorithm>
#include <cmath>

namespace orthonav::nav {
namespace {

/// A larger offset is not one of a tool at a screw, and would not fit the display.
constexpr double kMostShown = 9999.0;
/// 1.2 mm is 12 tenths, regardless of the last bits.
constexpr double kLastBits = 1e-6;

int rounded_up(double tenths) { return static_cast<int>(std::ceil(tenths - kLastBits)); }

ShownNumber shown(SteadyNumber& number, const NumberWithSd& measured, double tenth,
                  double sure_sd) {
  ShownNumber out;
  const double sd = measured.sd / tenth;
  out.tenths = number.show(measured.value / tenth, sd);
  out.sure = measured.sd <= sure_sd;
  if (sd <= kMostShown) {
    out.sd_tenths = std::max(1, rounded_up(sd));
  }
  return out;
}

}  // namespace

int SteadyNumber::show(double tenths, double sd_tenths) {
  const double size = std::min(std::abs(tenths), kMostShown);
  const double zero_up_to = shown_ == 0 ? kLeaveZero : kEnterZero;
  if (size <= zero_up_to && size <= sd_tenths && std::isfinite(sd_tenths)) {
    shown_ = 0;
    return 0;
  }
  const int sign = tenths < 0.0 ? -1 : 1;
  int digits = std::max(1, rounded_up(size));
  if (shown_) {
    const int before = sign * *shown_;
    const bool still = before >= digits && size > before - 1 - kBand;
    digits = still ? before : digits;
  }
  shown_ = sign * digits;
  return *shown_;
}

ScrewNumbers ScrewNumberWriter::write(const AnatomicalDeviation& measured) {
  return {shown(tip_cranial_, measured.tip_cranial_m, kTenth_m, kSureOffset_m),
          shown(tip_medial_, measured.tip_medial_m, kTenth_m, kSureOffset_m),
          shown(aim_cranial_, measured.aim_cranial_rad, kTenth_rad, kSureAngle_rad),
          shown(aim_medial_, measured.aim_medial_rad, kTenth_rad, kSureAngle_rad)};
}

}  // namespace orthonav::nav
