#pragma once

#include <cstdint>
#include <numbers>
#include <optional>

#include "nav/guidance/anatomical_deviation.h"

namespace orthonav::nav {

/// A number as displayed to the surgeon, in tenths of a millimetre or of a degree.
struct ShownNumber {
  int tenths = 0;                ///< > 0: cranial or medial
  std::optional<int> sd_tenths;  ///< of its error, rounded up; absent: not known
  bool sure = false;             ///< otherwise it is greyed and shown with its SD
};

/// `AnatomicalDeviation` as it is shown.
struct ScrewNumbers {
  ShownNumber tip_cranial;  ///< tenths of a millimetre
  ShownNumber tip_medial;
  ShownNumber aim_cranial;  ///< tenths of a degree
  ShownNumber aim_medial;
};

/// Whether a single number can be relied on.
enum class Certainty : std::uint8_t {
  kSure,     ///< its SD is at most `kSureOffset_m` or `kSureAngle_rad`: the number as measured
  kBound,    ///< it is not: in place of the number its bound of 95 % probability
  kUnknown,  ///< nobody knows: the number as measured, never shown as good
};
/// What the depth of the tip along the planned axis is counted to.
enum class DepthTo { kEntry, kTarget, kPastTarget };
/// The depth of the tip as displayed: so much to the entry or to the target, or past the target.
struct ShownDepth {
  DepthTo to = DepthTo::kEntry;
  int tenths = 0;  ///< of a millimetre, >= 0
  /// `kBound`: of what is left at least so much, past the target at most so much.
  Certainty certainty = Certainty::kUnknown;
};
/// How large a deviation is, whatever its direction, as displayed; `kBound`: at most so much.
struct ShownSize {
  int tenths = 0;  ///< of a millimetre or of a degree, >= 0
  Certainty certainty = Certainty::kUnknown;
};
/// What the quiet view says of a tool beside its depth.
struct ScrewSizes {
  ShownSize angle;   ///< between the tool and the planned axis
  ShownSize offset;  ///< of the tip from the planned axis
};
inline constexpr double kTenth_m = 1e-4;
inline constexpr double kTenth_rad = 0.1 * std::numbers::pi / 180.0;

/// A number is sure if its SD is at most this. 1.0 mm: 95 % of its errors lie within 2 mm, one step
/// of the Gertzbein-Robbins scale. 1.5°: 95 % of them move the end of a screw of 40 mm by no more
/// than those 2 mm.
inline constexpr double kSureOffset_m = 1.0e-3;
inline constexpr double kSureAngle_rad = 1.5 * std::numbers::pi / 180.0;

/// Decides which whole number of tenths is displayed for a measured number, so that it never looks
/// better than measured and a trembling hand does not make the last digit flicker. One object per
/// number.
///
/// The magnitude is rounded up. A larger one is shown at once; a smaller one only when the measured
/// number has fallen by another tenth below the point where rounding changes. The displayed number
/// is thus never below the measured one, and above it by less than two tenths. Zero is the only
/// exception: it appears at half a tenth or less, stays up to one tenth, and in both cases only
/// while the measured number is no larger than its SD, that is, indistinguishable from zero.
class SteadyNumber {
 public:
  static constexpr double kBand = 1.0;       ///< tenths, towards the safe side
  static constexpr double kEnterZero = 0.5;  ///< tenths
  static constexpr double kLeaveZero = 1.0;

  /// `tenths` is finite; `sd_tenths` may be infinite.
  int show(double tenths, double sd_tenths);
  void forget() { shown_.reset(); }

 private:
  std::optional<int> shown_;
};

/// Writes the depth, pair after pair. A tip that is shown short of where it is tempts the surgeon
/// to drill on, so the depth is rounded deeper, and one that is not sure is its deeper bound. A
/// smaller depth is shown once the measured one has fallen by another tenth, as with
/// `SteadyNumber`.
class DepthWriter {
 public:
  /// `depth_m`: past the entry along the planned axis; `to_target_m`: what is left of it. Absent if
  /// either is not finite or a metre or more.
  [[nodiscard]] std::optional<ShownDepth> write(const NumberWithSd& depth_m, double to_target_m);
  void forget() { *this = {}; }

 private:
  std::optional<int> past_entry_;   ///< shown last, tenths
  std::optional<int> past_target_;  ///< likewise
};

/// Writes the sizes of angle and offset, pair after pair. The bound of a size with an error of this
/// SD along each of two axes: 95 % of such errors are shorter than 2.45 SDs.
class ScrewSizeWriter {
 public:
  [[nodiscard]] ScrewSizes write(const NumberWithSd& angle_rad, const NumberWithSd& offset_m);
  void forget() { *this = {}; }

 private:
  SteadyNumber angle_;
  SteadyNumber offset_;
};

/// Writes all four numbers, pair after pair.
class ScrewNumberWriter {
 public:
  [[nodiscard]] ScrewNumbers write(const AnatomicalDeviation& measured);
  /// Forgets the numbers shown so far: the screw has changed, or the tool was not measured.
  void forget() { *this = {}; }

 private:
  SteadyNumber tip_cranial_;
  SteadyNumber tip_medial_;
  SteadyNumber aim_cranial_;
  SteadyNumber aim_medial_;
};

}  // namespace orthonav::nav
