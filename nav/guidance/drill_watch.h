#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/time.h"
#include "base/vec.h"

namespace orthonav::nav {

/// Which deviations of a drill raise an alarm.
///
/// Rampersaud et al. 2001 ("Accuracy requirements for image-guided spinal pedicle screw placement",
/// Spine 26:352-359) leave between 0 mm at T5 and 3.8 mm and 12.7° at L5 before a screw breaks
/// through. In many pedicles a screw thus breaks through before it is off by the 2 mm of a
/// Gertzbein-Robbins step, so 2 mm are red. Amber comes at half of that, where a drill that has
/// just entered can still be corrected. The angles move the tip by the same distances over some 28
/// mm of pedicle and body.
inline constexpr double kAmberOffset_m = 0.001;  ///< of the tip from the planned axis
inline constexpr double kRedOffset_m = 0.002;
inline constexpr double kAmberAngle_rad = 0.0349065850398866;  ///< 2°, between tool, planned axis
inline constexpr double kRedAngle_rad = 0.0698131700797732;    ///< 4°

/// The drill in one pair in which it was measured.
struct DrillReading {
  Timestamp time{};
  Vec3 tip_m;                ///< in the vertebra
  double from_bone_m = 0.0;  ///< of the tip from the bone's surface, either way
  double off_axis_m = 0.0;   ///< of the tip from the planned axis
  double angle_rad = 0.0;    ///< between tool and planned axis
  double depth_m = 0.0;      ///< past the planned entry, along the planned axis
  double depth_sd_m = 0.0;   ///< infinite: not known
  double to_target_m = 0.0;  ///< along the planned axis; < 0: past it
  /// How far past the place where its tip was set the depth stop lets the drill go; absent: no
  /// stop.
  std::optional<double> stop_m = {};
};

enum class DrillPhase : std::uint8_t {
  kAway,      ///< not at the entry
  kSet,       ///< the tip rests on the bone at the entry
  kDrilling,  ///< watched in every pair
};
/// In the order of their urgency.
enum class DrillAlarm : std::uint8_t { kNone, kAmber, kRed, kStop };

struct DrillView {
  DrillPhase phase = DrillPhase::kAway;
  /// The alarm in this pair. Amber and red need a measurement in the pair; a stop stays until the
  /// tip has been seen withdrawn, since the depth of a hidden tip is unknown.
  DrillAlarm alarm = DrillAlarm::kNone;
  bool watched = false;  ///< measured in this pair
  /// How far past the target the depth stop lets the drill go; < 0: it ends short of the target.
  /// Computed from where the tip was set, or, until it is set, from the planned entry. Absent:
  /// there is no stop, or the tool was not yet measured at this screw.
  std::optional<double> stop_past_target_m = {};
  /// The same for a pair without a measurement: drilling continues, and only a stop stays.
  [[nodiscard]] DrillView unwatched() const {
    return {phase, alarm == DrillAlarm::kStop ? alarm : DrillAlarm::kNone, false,
            stop_past_target_m};
  }
  friend bool operator==(const DrillView&, const DrillView&) = default;
};

/// Decides whether the surgeon is drilling, and with which alarm. Values in, values out; allocates
/// nothing.
class DrillWatch {
 public:
  /// The surgeon has said that they are drilling, wherever the tip is.
  void begin();
  void measured(const DrillReading& reading);
  /// A pair in which the drill was not measured.
  void not_measured() { view_ = view_.unwatched(); }
  /// Starts anew for another screw.
  void forget();
  [[nodiscard]] const DrillView& view() const { return view_; }
  /// How far before the target the stop comes.
  [[nodiscard]] double stop_margin_m(double depth_sd_m) const;

 private:
  void look_for_rest(const DrillReading& reading);
  void look_for_advance(const DrillReading& reading);
  void judge(const DrillReading& reading);
  void look_at_stop(const DrillReading& reading);

  DrillView view_;
  std::optional<DrillReading> rest_;  ///< at the time the tip came to rest, in `kAway`
  Timestamp newest_{};
  std::optional<double> set_depth_m_;  ///< where the tip was set, or first seen after `begin`
};

}  // namespace orthonav::nav
