#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hal/api/devices.h"
#include "hal/sim/error_model.h"
#include "hal/sim/surgeon/drilling.h"
#include "hal/sim/surgeon/grip.h"
#include "hal/sim/surgeon/head_motion.h"
#include "hal/sim/surgeon/script.h"

namespace orthonav::sim {

/// What the surgeon's body is doing at a tick, without tremor.
struct Posture {
  std::optional<ToolKind> in_hand;
  Grip grip;
  /// Outward normal of the bone that the tip rests on.
  std::optional<Vec3> contact_normal;
  bool on_wire = false;   ///< a wire is in the tool's sleeve: it no longer turns, and slides along
  std::size_t level = 0;  ///< index of the one that the hands work on and move with
  std::optional<Drilling> drilling;  ///< while a wire is driven
  Vec3 pushed_m{};                   ///< how far the instrument has pushed the bone, in Room
  HeadGoal head;
};

/// Hand, head, voice and thumb, with the movements from which every task is composed. Durations are
/// those of a surgeon of median pace; `slowness` stretches them.
class SurgeonBody {
 public:
  /// The error model must outlive it.
  SurgeonBody(Random random, const ErrorModel& error_model, double slowness, const Posture& start);

  /// A tick of the simulation: the script awaiting it continues.
  void tick(Timestamp now);
  [[nodiscard]] Metronome::NextTick next_tick() { return metronome_.next_tick(); }
  [[nodiscard]] Timestamp now() const { return now_; }
  [[nodiscard]] double slowness() const { return slowness_; }
  [[nodiscard]] Random& random() { return random_; }
  [[nodiscard]] const Posture& posture() const { return posture_; }
  [[nodiscard]] Posture& posture() { return posture_; }

  /// Holds still.
  Script rest(double duration_s);
  /// Moves the tool with a minimum-jerk profile (Flash and Hogan 1985), lifted on the way.
  Script move(Grip goal, double duration_s, double lift_m = 0.0);
  /// Puts the current tool away and brings the wanted one over `site`.
  Script take(ToolKind tool, Point<Room> site);
  void look(Point<Room> site, std::optional<Vec3> from = std::nullopt);

  void press();
  void release();
  Script click();
  Script double_click();
  void say(const std::string& phrase);

  /// Actions since the last tick, for the devices to deliver.
  std::vector<ClickerEvent> clicks;
  std::vector<Phrase> phrases;

  /// How the pointer is held over a place: leaning away from the head, so that its tag is visible.
  [[nodiscard]] Vec3 pointer_axis(Vec3 surface_normal) const;
  /// The direction from which the tag of a tool along `axis` is seen well while the surgeon stays
  /// at the side of the table; and another tag, if its normal is given, not too much from the side.
  [[nodiscard]] static Vec3 best_view(Vec3 axis, std::optional<Vec3> beside);

 private:
  [[nodiscard]] Grip parked(Point<Room> site) const;

  Random random_;
  const ErrorModel* error_model_;
  double slowness_;
  Posture posture_;
  Timestamp now_{};
  Metronome metronome_;
  ClickTimer button_;
};

/// Fraction of the way after a fraction of the time, without jerk at the ends.
[[nodiscard]] constexpr double minimum_jerk(double t) {
  return t * t * t * (10.0 + t * (-15.0 + 6.0 * t));
}

}  // namespace orthonav::sim
