#include "nav/guidance/screw_numbers.h"

#include <algorithm>
#include <cmath>

namespace orthonav::nav {
namespace {

/// A larger offset is not one of a tool at a screw, and would not fit the display.
constexpr double kMaxShown = 9999.0;
/// 1.2 mm is 12 tenths, regardless of the last bits.
constexpr double kLastBits = 1e-6;
/// 95 % of the errors along an axis lie on the safe side of so many SDs,
constexpr double kBoundSds = 1.645;
/// and 95 % of those across an axis are shorter than so many.
constexpr double kBoundSdsAcross = 2.448;

int rounded_up(double tenths) { return static_cast<int>(std::ceil(tenths - kLastBits)); }

/// Rounded up; `before`, what was shown last, stays until the number has fallen by another tenth.
int rounded_up_steadily(double tenths, std::optional<int> before) {
  const int up = rounded_up(tenths);
  const bool still = before && *before >= up && tenths > *before - 1 - SteadyNumber::kBand;
  return still ? *before : up;
}

std::optional<int> shown_sd(double sd_tenths) {
  return sd_tenths <= kMaxShown ? std::optional(std::max(1, rounded_up(sd_tenths))) : std::nullopt;
}

ShownNumber shown(SteadyNumber& number, const NumberWithSd& measured, double tenth,
                  double sure_sd) {
  ShownNumber out;
  const double sd = measured.sd / tenth;
  out.tenths = number.show(measured.value / tenth, sd);
  out.sure = measured.sd <= sure_sd;
  out.sd_tenths = shown_sd(sd);
  return out;
}

Certainty certainty_of(double sd, double sure_sd) {
  if (sd <= sure_sd) {
    return Certainty::kSure;
  }
  return std::isfinite(sd) ? Certainty::kBound : Certainty::kUnknown;
}

ShownSize shown_size(SteadyNumber& number, const NumberWithSd& size, double tenth, double sure_sd) {
  const Certainty certainty = certainty_of(size.sd, sure_sd);
  const double more = certainty == Certainty::kBound ? kBoundSdsAcross * size.sd : 0.0;
  return {std::abs(number.show((size.value + more) / tenth, size.sd / tenth)), certainty};
}

}  // namespace

int SteadyNumber::show(double tenths, double sd_tenths) {
  const double size = std::min(std::abs(tenths), kMaxShown);
  const double zero_up_to = shown_ == 0 ? kLeaveZero : kEnterZero;
  if (size <= zero_up_to && size <= sd_tenths && std::isfinite(sd_tenths)) {
    shown_ = 0;
    return 0;
  }
  const int sign = tenths < 0.0 ? -1 : 1;
  const auto before = shown_ ? std::optional(sign * *shown_) : std::nullopt;
  shown_ = sign * std::max(1, rounded_up_steadily(size, before));
  return *shown_;
}

std::optional<ShownDepth> DepthWriter::write(const NumberWithSd& depth_m, double to_target_m) {
  const Certainty certainty = certainty_of(depth_m.sd, kSureOffset_m);
  const double deeper_m = certainty == Certainty::kBound ? kBoundSds * depth_m.sd : 0.0;
  const double past_entry = (depth_m.value + deeper_m) / kTenth_m;
  const double past_target = (deeper_m - to_target_m) / kTenth_m;
  if (!(std::abs(past_entry) <= kMaxShown && std::abs(past_target) <= kMaxShown)) {
    forget();
    return std::nullopt;
  }
  past_entry_ = rounded_up_steadily(past_entry, past_entry_);
  past_target_ = rounded_up_steadily(past_target, past_target_);
  ShownDepth out;
  if (*past_entry_ < 0) {
    out.tenths = -*past_entry_;
  } else {
    out.to = *past_target_ > 0 ? DepthTo::kPastTarget : DepthTo::kTarget;
    out.tenths = std::abs(*past_target_);
  }
  out.certainty = certainty;
  return out;
}

ScrewSizes ScrewSizeWriter::write(const NumberWithSd& angle_rad, const NumberWithSd& offset_m) {
  return {shown_size(angle_, angle_rad, kTenth_rad, kSureAngle_rad),
          shown_size(offset_, offset_m, kTenth_m, kSureOffset_m)};
}

ScrewNumbers ScrewNumberWriter::write(const AnatomicalDeviation& measured) {
  return {shown(tip_cranial_, measured.tip_cranial_m, kTenth_m, kSureOffset_m),
          shown(tip_medial_, measured.tip_medial_m, kTenth_m, kSureOffset_m),
          shown(aim_cranial_, measured.aim_cranial_rad, kTenth_rad, kSureAngle_rad),
          shown(aim_medial_, measured.aim_medial_rad, kTenth_rad, kSureAngle_rad)};
}

}  // namespace orthonav::nav
