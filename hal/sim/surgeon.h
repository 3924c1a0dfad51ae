#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hal/sim/error_model.h"
#include "hal/sim/eyes.h"
#include "hal/sim/guidance_profile.h"
#include "hal/sim/number_reading.h"
#include "hal/sim/room_layout.h"
#include "hal/sim/standing_metal.h"
#include "hal/sim/stroke_plan.h"
#include "hal/sim/surgeon_body.h"

namespace orthonav::sim {

/// What the surgeon knows of their own body and of the patient's, whatever the display shows.
struct Bearings {
  Point<Room> eyes;
  /// Of each level, with the breath, in Room; the hands go with the level that they work on. What
  /// it views must last for the tick.
  std::span<const Vec3> levels_moved_m;
};

/// The scripted surgeon. Knows the bones as they lie there (strokes them, compares holograms with
/// them), sees the screw heads already placed, sets a sleeve over the wires that stand there, and
/// learns everything else from the display. Answers each step of the workflow as the status line
/// names it.
class Surgeon {
 public:
  /// The layout and the eyes must outlive it. How what stands in the bones lies against the plan
  /// nobody tells the surgeon but the display.
  Surgeon(const RoomLayout& layout, const ErrorModel& error_model, const Random& random,
          const Eyes& eyes, StandingMetal metal, GuidanceProfile guidance);

  /// Lives on to `now`.
  void tick(Timestamp now, const Bearings& bearings);
  [[nodiscard]] SurgeonBody& body() { return body_; }
  /// Has seen the end of the operation, or has given up.
  [[nodiscard]] bool finished() const { return finished_; }
  [[nodiscard]] bool gave_up() const { return gave_up_; }

 private:
  /// Whoever waits for a step says so again each minute, and gives up in the end.
  static constexpr double kPatience_s = 60.0;
  static constexpr int kRepeats = 5;
  /// So long a tool or a hologram may stay out of sight.
  static constexpr double kLongPatience_s = 300.0;
  /// Refusals and rejections of a level.
  static constexpr int kMaxFailures = 3;

  /// Where a screw is to go, as perceived.
  struct Aim {
    BoneSpot on_bone;  ///< in Room
    Vec3 outwards;     ///< the planned axis, out of the bone
    SpokenDirections directions;
  };
  Script operate();
  Script perform(StepOnDisplay step);
  Script set_up();
  Script verify(std::size_t level);
  /// Holds the shown bone against the real one for a while; notes whether the line asked for
  /// touches meanwhile.
  Script compare_overlay(std::size_t level, bool& fits, bool& asked_to_touch);
  /// Waits until the status line leaves `step`, or, where none is given, until there is one;
  /// repeats the phrase each minute, then gives up.
  Script await_change(std::optional<StepOnDisplay> step, std::string phrase);

  // surgeon_checking.cpp
  /// Touches spread places of the bone until the status line asks for no more; `fits` becomes false
  /// when it says that the registration must go.
  Script check_by_touch(std::size_t level, bool& fits);
  Script touch_place(const StepOnDisplay& step, const BoneSpot& place);
  /// Rests the pointer's tip there and clicks, again where the line says that it was not taken.
  Script touch_at(const StepOnDisplay& step, Point<Room> tip, Vec3 normal);
  /// Of a tip that was set there; `read_s`, on the clock, is how long the line is looked at.
  Script click_at_rest(const StepOnDisplay& step, Vec3 normal, double settle_s, double read_s);
  /// Rests and clicks; where the line says that it was not taken, rests a second and clicks again.
  /// Both durations are a median surgeon's.
  Script click_until_taken(const StepOnDisplay& step, double settle_s, double read_s);
  /// Spread over what can be stroked, each well away from those before it.
  [[nodiscard]] std::vector<BoneSpot> places_to_check(std::size_t level);
  [[nodiscard]] bool told(Notice notice) const {
    return eyes_->status() && eyes_->status()->notice == notice;
  }
  [[nodiscard]] bool asked(ChecksAsked checks) const {
    return eyes_->status() && eyes_->status()->checks == checks;
  }

  // surgeon_landmark.cpp
  /// Makes a dimple in the bone, or finds it again, and touches it.
  Script touch_landmark(std::size_t level);
  /// Puts the guide into the same dimple.
  Script compare_tips(std::size_t level);
  /// To what the line offers to correct of the guide: its tip, its axis.
  Script consent_to_corrections(const StepOnDisplay& step);

  // surgeon_digitizing.cpp
  Script digitize(std::size_t level);
  Script record(std::size_t level, const StrokeRegion& region, bool slips);
  Script slide(std::size_t level, const Stroke& stroke, double duration_s, bool slips);
  /// Seconds of stroking a metre of bone, and around each region, for the median surgeon.
  struct Tempo {
    double stroking_s_per_m = 0.0;
    double around_region_s = 0.0;
  };
  [[nodiscard]] Tempo tempo(std::size_t level) const;
  Script await_verdict(std::size_t level, StepOnDisplay step);

  // surgeon_guiding.cpp
  Script guide(std::size_t level, Side side);
  Script find_entry(const StepOnDisplay& step, std::size_t level, Side side, Aim& aim);
  /// Averages what is seen of entry and axis for a while; `found` stays false when the step ends.
  Script look_at_entry(const StepOnDisplay& step, std::size_t level, Side side, double look_s,
                       bool& found, Vec3& entry, Vec3& outwards);
  Script set_on(const Aim& aim);
  /// Aims the tool by what the guidance profile lets the surgeon go by.
  Script aim_tool(const StepOnDisplay& step, std::size_t level, const Aim& aim);
  Script drive_wire(std::size_t level, Side side, const Aim& aim);
  /// Moves hand and wire in together, turning as hands do; in a closed loop, by what is read.
  Script drill(const Aim& aim, Vec3 turn_of_wire);
  [[nodiscard]] BoneSpot put_on_bone(std::size_t level, Vec3 entry, Vec3 outwards) const;

  // surgeon_perceiving.cpp
  /// A draw of how far off a place is perceived: more along the line of sight than across it.
  [[nodiscard]] Vec3 misperceived(Point<Room> place, double across_sd_m);
  /// Of the level that is worked on, with the breath.
  [[nodiscard]] Vec3 moved_m() const { return bearings_.levels_moved_m[body_.posture().level]; }
  /// Where a hologram's point hangs, relative to a patient who does not breathe.
  [[nodiscard]] Point<Room> seen_at_rest(Point<World> in_world) const {
    return eyes_->place(in_world) - moved_m();
  }
  /// Holds the tool along the shown trajectory by eye.
  Script align_by_eye(const StepOnDisplay& step, const Aim& aim);
  /// Moves the tip until the numbers say that it is on the planned axis.
  Script centre_tip(const StepOnDisplay& step, std::size_t level, const Aim& aim);
  /// The mean offset of the tip that the numbers say over a while; nothing when there are none.
  Script read_offset(const StepOnDisplay& step, const Aim& aim, std::optional<Vec3>& offset_m);

  // surgeon_turning.cpp
  /// Turns the tool about its tip until the readings are small and steady.
  Script turn_tool(const StepOnDisplay& step, const Aim& aim);
  /// Holds still, reads the average and takes out what is left of it, if that is little.
  Script settle(const Aim& aim, double content_rad, bool& settled);
  /// How the tool has to be turned: by the numbers in a closed loop, else by cross and triangle.
  [[nodiscard]] std::optional<Deviation> read_turn(const Aim& aim) const;
  void turn_by(Vec3 turn);
  /// What they do where there is no reading; true when it has been away for so long that those
  /// before it are out of date.
  bool regain_reading(const Aim& aim, double lost_s, double tick_s);
  /// Turns the tag to and fro and leans over, so that the cameras find it again.
  void show_tag(const Aim& aim, double since_s, double tick_s);

  // surgeon_placing.cpp
  /// Measures the wire of the screw that was drilled, and keeps or redoes it.
  Script look_at_wire(std::size_t level, Side side);
  /// Sets the guide's sleeve over it, turns it to and fro and clicks, again where the line says
  /// that it was not taken.
  Script set_sleeve_over(const StepOnDisplay& step, std::size_t level, const StandingWire& wire);

  // surgeon_rod.cpp
  Script touch_heads(Side side);

  [[nodiscard]] bool sees_now() const;
  /// The step that the status line names; there is one.
  [[nodiscard]] const StepOnDisplay& step_now() const { return eyes_->status()->at; }
  [[nodiscard]] bool in_step(const StepOnDisplay& step) const {
    return eyes_->status() && step_now() == step;
  }
  void give_up();

  const RoomLayout* layout_;
  const ErrorModel* error_model_;
  const Eyes* eyes_;
  StandingMetal metal_;
  SurgeonBody body_;
  GuidanceProfile guidance_;
  Vec3 misread_rad_{};  ///< of the angle, drawn before the wire went in; lasts while it does
  Bearings bearings_;
  Random checking_;  ///< of its own: who need not touch draws the same from the others
  Random seating_;   ///< of the tip in a dimple; of its own likewise
  Random sleeving_;  ///< of the sleeve over a wire; of its own likewise
  double lightness_ = 1.0;
  std::vector<std::vector<StrokeRegion>> regions_;  ///< for each level; empty where not operated
  std::vector<int> failures_;                       ///< refusals and rejections, for each level
  std::vector<std::optional<BoneSpot>> dimples_;    ///< in Vertebra, for each level
  std::vector<int> moved_;  ///< how often its landmark had moved since a level was registered
  std::set<StepOnDisplay> redone_;  ///< guide steps whose wire was taken out once
  std::set<StepOnDisplay> driven_;  ///< guide steps whose wire is in
  bool finished_ = false;
  bool gave_up_ = false;
  Script life_;
};

}  // namespace orthonav::sim
