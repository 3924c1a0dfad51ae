#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/time.h"
#include "base/vec.h"

namespace orthonav::nav {

/// When a drill is watched, and from where on it is off.
///
/// The deviation: Rampersaud et al. 2001 ("Accuracy requirements for image-guided spinal pedicle
/// screw placement", Spine 26:352-359) leave between 0 mm at T5 and 3.8 mm and 12.7° at L5 before a
/// screw breaks through. The 2 mm of a Gertzbein-Robbins step are thus spent in many pedicles
/// before they are reached, so they are red; amber comes at half of it, where a drill that has just
/// entered can still be turned back. The angles are those that move the tip by as much over some 28
/// mm of pedicle and body.
struct DrillLimits {
  double amber_offset_m = 0.001;  ///< of the tip from the planned axis
  double red_offset_m = 0.002;
  double amber_angle_rad = 0.0349065850398866;  ///< 2°, between tool and planned axis
  double red_angle_rad = 0.0698131700797732;    ///< 4°
  double set_within_m = 0.002;     ///< a tip so near to the bone's surface may be set on it
  double set_near_axis_m = 0.005;  ///< and so near to the planned axis
  Duration set_after = std::chrono::milliseconds(500);  ///< at rest for so long
  double set_spread_m = 0.001;                          ///< a tip that moves farther does not rest
  double advance_m = 0.002;    ///< deeper than it was set by so much: it drills
  double withdrawn_m = 0.005;  ///< out by so much from where it was set: it drills no longer
  /// The stop comes while the tip is short of the target by so many SDs of its depth: with 95 %
  /// probability it has not reached it,
  double stop_sds = 1.645;
  /// but by no less than that: a hand that stops a quarter of a second later has drilled on by 0.75
  /// mm at 3 mm a second,
  double least_stop_margin_m = 0.001;
  /// and by that where nobody knows the SD.
  double unknown_stop_margin_m = 0.005;
  double stop_released_m = 0.002;  ///< short of the stop by so much again, it is taken back

  /// Every problem at once; empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

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
  /// How far the depth stop lets the drill get past where its tip was set; absent: there is none.
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
  /// Of this pair. Amber and red go with the measurement; a stop stays until the tip was seen to be
  /// withdrawn, for nobody knows how deep a hidden tip is.
  DrillAlarm alarm = DrillAlarm::kNone;
  bool watched = false;  ///< measured in this pair
  /// So far the depth stop lets the drill past the target; < 0: it ends before. Of where the tip
  /// was set, and until then as if it were set on the planned entry. Absent: there is no stop, or
  /// the tool was not measured yet at this screw.
  std::optional<double> stop_past_target_m = {};
  /// The same while nobody watches: it drills on, and only a stop stays.
  [[nodiscard]] DrillView unwatched() const {
    return {phase, alarm == DrillAlarm::kStop ? alarm : DrillAlarm::kNone, false,
            stop_past_target_m};
  }
  friend bool operator==(const DrillView&, const DrillView&) = default;
};

/// Whether the surgeon drills, and how it goes. Values in, values out; allocates nothing.
class DrillWatch {
 public:
  explicit DrillWatch(const DrillLimits& limits = {}) : limits_(limits) {}

  /// The surgeon says that they drill, wherever the tip is.
  void begin();
  void measured(const DrillReading& reading);
  /// A pair in which the drill was not measured.
  void not_measured() { view_ = view_.unwatched(); }
  /// Another screw.
  void forget();
  [[nodiscard]] const DrillView& view() const { return view_; }
  /// Before the target by so much comes the stop.
  [[nodiscard]] double stop_margin_m(double depth_sd_m) const;

 private:
  void look_for_rest(const DrillReading& reading);
  void look_for_advance(const DrillReading& reading);
  void judge(const DrillReading& reading);
  void look_at_stop(const DrillReading& reading);

  DrillLimits limits_;
  DrillView view_;
  std::optional<DrillReading> rest_;  ///< when the tip came to rest, in `kAway`
  Timestamp newest_{};
  std::optional<double> set_depth_m_;  ///< where the tip was set, or first seen after `begin`
};

}  // namespace orthonav::nav
