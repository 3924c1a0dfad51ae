#pragma once

#include <optional>
#include <variant>

#include "base/angle.h"
#include "engine/session/landmark.h"
#include "engine/session/log/operation_json.h"
#include "engine/session/tool_in_vertebra.h"
#include "engine/session/touch.h"
#include "nav/calibration/spin.h"

namespace orthonav::engine {

struct SessionState;
struct SessionOptions;

/// The guide's tip compared with the pointer's, both put into the same landmark. The pointer
/// determines where the bone is, and the guide is aimed there, so an error that they do not share
/// affects every entry.
struct TipDifference {
  Vec3 apart_m;       ///< from the pointer's tip to the guide's, in the guide's marker
  double sd_m = 0.0;  ///< of `apart_m`, along an axis
  /// Their most probable difference, from prior knowledge and this measurement.
  Vec3 by_m;
  double limit_m = 0.0;    ///< of `apart_m`: beyond it, `by_m` is offered as a correction
  bool corrected = false;  ///< with the surgeon's consent

  [[nodiscard]] bool agrees() const { return apart_m.norm() <= limit_m; }
};

/// Tags that are 0.3 % larger put their tool 1.35 mm too far away at this distance from the
/// cameras. Seen from another side the same error points in another direction, so no correction of
/// the tip removes it: the uncertainty of the two tools' tag sizes is part of the difference's SD.
inline constexpr double kTagDistance_m = 0.45;

/// Done after the landmark was touched: before each screw with a patient reference, once in an
/// operation without, or again at the surgeon's choice. Before a screw the guide is held as for the
/// screw: what a comparison can't tell apart, the guide's tip (which turns with it) and the
/// pointer's (which shifted the registered bone), then adds up as it did at the landmark.
class TipCheck {
 public:
  /// `prior_sd_m`: SD along an axis of the distance between the two described tips after
  /// calibration. `compare` false: the tips are not asked for.
  explicit TipCheck(double prior_sd_m, bool compare = true)
      : prior_sd_m_(prior_sd_m), compare_(compare) {}

  /// Compares the guide's tip at `place`, with the guide at `world_from_guide`, with the pointer's
  /// earlier tip at `pointer_tip`; or says why it does not count. `size_sd`: SD of the size
  /// difference between the tags of both, as a fraction.
  [[nodiscard]] std::variant<TipDifference, TouchRefusal> take(
      const nav::PressedPlace& place, const Transform<World, Marker>& world_from_guide,
      const nav::PressedPlace& pointer_tip, bool anchored, double size_sd);
  /// How the guide was held against the bone in the last comparison.
  void held(const Mat3& bone_from_guide) { held_ = bone_from_guide; }
  /// Another screw is next: the guide is to be compared as it is held for that one.
  void expect() {
    compared_ = false;
    for_screw_ = true;
  }
  /// Whether it matters how the guide is held: with a comparison before each screw.
  [[nodiscard]] bool for_screw() const { return for_screw_; }
  /// Still to be done.
  [[nodiscard]] bool due() const { return compare_ && !compared_; }
  /// A difference waits for consent to be corrected; that of an earlier screw no longer does.
  [[nodiscard]] bool offers() const { return compared_ && !last_->corrected && !last_->agrees(); }
  /// SD along an axis of the guide's tip relative to the pointer's, as currently known, with the
  /// guide held so against the bone; `size_sd` as in `take`.
  [[nodiscard]] double difference_sd_m(double size_sd, const Mat3& bone_from_guide) const;
  /// The surgeon consents. Returns what to subtract from the guide's tip.
  [[nodiscard]] Vec3 correct();
  [[nodiscard]] const std::optional<TipDifference>& last() const { return last_; }

 private:
  [[nodiscard]] double along_sight_m(double size_sd) const;

  double prior_sd_m_ = 0.0;
  bool compare_ = true;
  bool compared_ = false;  ///< for the next screw
  bool for_screw_ = false;
  std::optional<TipDifference> last_;
  Mat3 held_ = Mat3::identity();
};

/// The guide's axis as measured by turning its sleeve over a wire in the bone, compared with the
/// axis in use.
struct AxisDifference {
  double off_rad = 0.0;  ///< as measured
  double sd_rad = 0.0;   ///< of `off_rad`, about each direction across the axis
  /// The most probable error of the axis in use, from prior knowledge and this measurement.
  double by_rad = 0.0;
  bool corrected = false;  ///< with the surgeon's consent
};

/// No measurement of an axis is assumed to be better than this: errors of tags and lenses are the
/// same in all poses. 0.1°.
inline constexpr double kLeastAxisSd_rad = 0.1 * kRadiansPerDegree;
/// A smaller correction of an axis is not offered.
inline constexpr double kAxisWorth_rad = 0.15 * kRadiansPerDegree;

/// SD about each direction across the axis of an axis measured by turning the sleeve; the
/// calibration states the SD of both directions together.
[[nodiscard]] double sd_of_each_rad(const nav::SpinCalibration& measured);

/// Each wire measured this way improves the estimate of the axis; a correction counts as known from
/// then on.
class AxisCheck {
 public:
  /// `prior_sd_rad`: SD of the described axis about each direction across it.
  explicit AxisCheck(double prior_sd_rad) : sd_rad_(prior_sd_rad) {}

  void take(const nav::SpinCalibration& measured, Direction<Marker> in_use);
  /// A difference waits for consent to be corrected.
  [[nodiscard]] bool offers() const {
    return last_ && !last_->corrected && last_->by_rad >= kAxisWorth_rad;
  }
  /// SD of the axis in use, about each direction across it.
  [[nodiscard]] double sd_rad() const { return sd_rad_; }
  /// The surgeon consents. Returns the axis to use from now on.
  [[nodiscard]] Direction<Marker> correct();
  [[nodiscard]] const std::optional<AxisDifference>& last() const { return last_; }

 private:
  double sd_rad_ = 0.0;  ///< of the axis in use
  std::optional<AxisDifference> last_;
  Direction<Marker> better_;
};

/// What an operation finds out about its guide: its tip compared with the pointer's in the
/// landmark, and its axis on the wires. Lasts for the whole operation.
class GuideChecks {
 public:
  explicit GuideChecks(const SessionOptions& options);

  /// Another screw is next: the tips are to be compared as the guide is held for it.
  void expect_tips() { tips_.expect(); }
  /// The guide's tip was put at `place` after the pointer's was at `pointer_tip`.
  void compare_tips(SessionState& work, const nav::PressedPlace& place,
                    const nav::PressedPlace& pointer_tip, Timestamp time);
  /// The sleeve was turned over a wire.
  void compare_axis(SessionState& work, const nav::SpinCalibration& spin, Timestamp time);
  /// The status line offers a correction, of the tip or of the axis.
  [[nodiscard]] bool offers() const { return tips_.offers() || axis_.offers(); }
  /// The surgeon consents to the one that is offered: of the tip first, then of the axis.
  void correct_guide(SessionState& work, Timestamp time);

  /// How far off the guide may be on the current level, as it was last seen.
  [[nodiscard]] ToolErrors errors(const SessionState& work, Timestamp now) const;
  [[nodiscard]] const TipCheck& tips() const { return tips_; }
  [[nodiscard]] const AxisCheck& axis() const { return axis_; }

 private:
  TipCheck tips_;
  AxisCheck axis_;
};

// Its records in the log; `json` holds the time already.

void log_tips(LogJson& json, const TipDifference& difference);
[[nodiscard]] TipDifference tips_from(const JsonNode& node);
void log_axis(LogJson& json, const AxisDifference& difference);
[[nodiscard]] AxisDifference axis_from(const JsonNode& node);

}  // namespace orthonav::engine
