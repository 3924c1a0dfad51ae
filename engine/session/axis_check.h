#pragma once

#include <optional>

#include "base/angle.h"
#include "nav/calibration/spin.h"

namespace orthonav::engine {

/// The guide's axis as measured by turning its sleeve over a wire in the bone, compared with the
/// axis in use.
struct AxisDifference {
  double off_rad = 0.0;  ///< as measured
  double sd_rad = 0.0;   ///< of `off_rad`, about each direction across the axis
  /// The most probable error of the axis in use, from prior knowledge and this measurement.
  double by_rad = 0.0;
  bool corrected = false;  ///< with the surgeon's consent
};

struct AxisCheckRules {
  /// SD of the described axis about each direction across it; a printed tool.
  double prior_sd_rad = 0.010;
  /// No measurement is assumed to be better than this: errors of tags and lenses are the same in
  /// all poses. 0.1°.
  double least_sd_rad = 0.1 * kRadiansPerDegree;
  /// A smaller correction is not offered.
  double worth_rad = 0.15 * kRadiansPerDegree;
};

/// SD about each direction across the axis of an axis measured by turning the sleeve; the
/// calibration states the SD of both directions together.
[[nodiscard]] double sd_of_each_rad(const nav::SpinCalibration& measured,
                                    double least_sd_rad = AxisCheckRules{}.least_sd_rad);

/// Each wire measured this way improves the estimate of the axis; a correction counts as known from
/// then on.
class AxisCheck {
 public:
  AxisCheck() : AxisCheck(AxisCheckRules{}) {}
  explicit AxisCheck(const AxisCheckRules& rules) : rules_(rules), sd_rad_(rules.prior_sd_rad) {}

  void take(const nav::SpinCalibration& measured, Direction<Marker> in_use);
  /// A difference waits for consent to be corrected.
  [[nodiscard]] bool offers() const {
    return last_ && !last_->corrected && last_->by_rad >= rules_.worth_rad;
  }
  /// SD of the axis in use, about each direction across it.
  [[nodiscard]] double sd_rad() const { return sd_rad_; }
  /// The surgeon consents. Returns the axis to use from now on.
  [[nodiscard]] Direction<Marker> correct();
  [[nodiscard]] const std::optional<AxisDifference>& last() const { return last_; }

 private:
  AxisCheckRules rules_;
  double sd_rad_ = 0.0;  ///< of the axis in use
  std::optional<AxisDifference> last_;
  Direction<Marker> better_;
};

}  // namespace orthonav::engine
