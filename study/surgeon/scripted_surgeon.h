#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "hal/sim/surgeon/stroke_plan.h"
#include "hal/sim/surgeon/surgeon.h"
#include "study/surgeon/deviation.h"
#include "study/surgeon/eyes.h"

namespace orthonav::sim {

/// The scripted surgeon. Knows where the bones are (strokes them, compares holograms with them),
/// sees the screw heads already placed, sets a sleeve over existing wires, and learns everything
/// else from the display. Reacts to each step of the workflow that the status line names.
class ScriptedSurgeon final : public Surgeon {
 public:
  explicit ScriptedSurgeon(const Workplace& workplace);
  /// For `SimOptions::surgeon`.
  static std::unique_ptr<Surgeon> bring(const Workplace& workplace) {
    return std::make_unique<ScriptedSurgeon>(workplace);
  }

  /// Reads frames written by ShownToWearer; others are not seen.
  void see(const WornFrame& frame, const Transform<Room, World>& room_from_world) override;
  void tick(Timestamp now, const Bearings& bearings) override;
  void see_reference(Vec3 faces) override { reference_faces_ = faces; }
  [[nodiscard]] SurgeonBody& body() override { return body_; }
  [[nodiscard]] bool finished() const override { return finished_; }
  [[nodiscard]] bool gave_up() const override { return gave_up_; }

 private:
  /// While waiting for a step, the phrase is repeated each minute, and finally the surgeon gives
  /// up.
  static constexpr double kPatience_s = 60.0;
  static constexpr int kRepeats = 5;
  /// Without a reading or a hologram for this long the surgeon acts.
  static constexpr double kLost_s = 1.0;
  /// How long a tool or a hologram may stay out of sight.
  static constexpr double kLongPatience_s = 300.0;
  /// Most refusals and rejections of a level.
  static constexpr int kMaxFailures = 3;

  /// Where a screw is to go, as perceived.
  struct Aim {
    BoneSpot on_bone;  ///< in Room
    Vec3 outwards;     ///< the planned axis, out of the bone
  };
  Script operate();
  Script perform(StepOnDisplay step);
  Script set_up();
  Script verify(std::size_t level);
  /// Compares the shown bone with the real one for a while; notes whether the line asked for
  /// touches meanwhile.
  Script compare_overlay(std::size_t level, bool& fits, bool& asked_to_touch);
  /// Waits until the status line leaves `step`, or, if none is given, until there is one; repeats
  /// the phrase each minute, then gives up.
  Script await_change(std::optional<StepOnDisplay> step, std::string phrase);

  // surgeon_checking.cpp
  /// Touches spread places on the bone until the status line asks for no more; `fits` becomes false
  /// if it says that the registration must be rejected.
  Script check_by_touch(std::size_t level, bool& fits);
  Script touch_place(const StepOnDisplay& step, const BoneSpot& place);
  /// Rests the pointer's tip there and clicks, again if the line says that the touch was not taken.
  Script touch_at(const StepOnDisplay& step, Point<Room> tip, Vec3 normal);
  /// The same with the tool along that axis, without moving the head.
  Script hold_at(const StepOnDisplay& step, Point<Room> tip, Vec3 normal, Vec3 axis);
  /// The same for a tip already there; `read_s` of simulated time is spent reading the line.
  Script click_at_rest(const StepOnDisplay& step, Vec3 normal, double settle_s, double read_s);
  /// Rests and clicks; if the line says that the touch was not taken, rests a second and clicks
  /// again. Both durations are those of a median surgeon.
  Script click_until_taken(const StepOnDisplay& step, double settle_s, double read_s);
  /// Spread over the surface that can be stroked, each well away from the earlier ones.
  [[nodiscard]] std::vector<BoneSpot> places_to_check(std::size_t level);
  /// On that surface, nearest to where the display shows a place to be touched; nothing if it shows
  /// none.
  [[nodiscard]] std::optional<BoneSpot> place_shown(std::size_t level);
  [[nodiscard]] bool told(Notice notice) const {
    return eyes_.status() && eyes_.status()->notice == notice;
  }
  [[nodiscard]] bool asked(ChecksAsked checks) const {
    return eyes_.status() && eyes_.status()->checks == checks;
  }

  // surgeon_landmark.cpp
  /// Makes a landmark in the bone, or finds it again, and touches it.
  Script touch_landmark(std::size_t level);
  /// Where a tip comes to lie in the level's landmark, and the bone's normal there.
  struct Seat {
    Point<Room> tip;
    Vec3 normal;
  };
  [[nodiscard]] Seat seat_in_landmark(std::size_t level);
  /// Puts the guide's tip into the same landmark.
  Script compare_tips(std::size_t level);
  /// With the guide held, and looked at, about as for the next screw.
  Script compare_tips_as_for_screw(std::size_t level);
  /// Accepts the corrections of the guide that the line offers: its tip, its axis.
  Script consent_to_corrections(const StepOnDisplay& step);

  // surgeon_digitizing.cpp
  Script digitize(std::size_t level);
  Script record(std::size_t level, const StrokeRegion& region, bool slips);
  Script slide(std::size_t level, const Stroke& stroke, double duration_s, bool slips);
  /// Seconds per metre of stroking, and around each region, for the median surgeon.
  struct Tempo {
    double stroking_s_per_m = 0.0;
    double around_region_s = 0.0;
  };
  [[nodiscard]] Tempo tempo(std::size_t level) const;
  Script await_verdict(std::size_t level, StepOnDisplay step);

  // surgeon_guiding.cpp
  Script guide(std::size_t level, Side side);
  Script find_entry(const StepOnDisplay& step, std::size_t level, Side side, Aim& aim);
  /// Averages the perceived entry and axis for a while; `found` stays false if the step ends.
  Script look_at_entry(const StepOnDisplay& step, std::size_t level, Side side, double look_s,
                       bool& found, Vec3& entry, Vec3& outwards);
  Script set_on(const Aim& aim);
  /// Aims the tool by what the guidance profile lets the surgeon go by.
  Script aim_tool(const StepOnDisplay& step, std::size_t level, const Aim& aim);
  Script drive_wire(std::size_t level, Side side, const Aim& aim);
  /// Moves hand and wire in together, turning as hands do; in a closed loop, by what is read.
  Script drill(const Aim& aim, Vec3 rotation_of_wire);
  [[nodiscard]] BoneSpot put_on_bone(std::size_t level, Vec3 entry, Vec3 outwards) const;

  // surgeon_perceiving.cpp
  /// A random error of a perceived place: larger along the line of sight than across it.
  [[nodiscard]] Vec3 misperceived(Point<Room> place, double across_sd_m) {
    return misperceived(body_.random(), place, across_sd_m);
  }
  [[nodiscard]] Vec3 misperceived(Random& random, Point<Room> place, double across_sd_m) const;
  /// Motion with the breath of the level being worked on.
  [[nodiscard]] Vec3 moved_m() const { return bearings_.levels_moved_m[body_.posture().level]; }
  /// Where a hologram's point appears, relative to a patient who does not breathe.
  [[nodiscard]] Point<Room> seen_at_rest(Point<World> in_world) const {
    return eyes_.place(in_world) - moved_m();
  }
  /// Holds the tool along the shown trajectory by eye.
  Script align_by_eye(const StepOnDisplay& step, const Aim& aim);
  /// Moves the tip until the numbers say that it is on the planned axis.
  Script centre_tip(const StepOnDisplay& step, std::size_t level, const Aim& aim);
  /// The mean offset of the tip, from the numbers over a while; nothing if there are none.
  Script read_offset(const StepOnDisplay& step, const Aim& aim, std::optional<Vec3>& offset_m);

  // surgeon_turning.cpp
  /// Turns the tool about its tip until the readings are small and steady.
  Script rotate_tool(const StepOnDisplay& step, const Aim& aim);
  /// Holds still, reads the average and takes out what is left of it, if that is little.
  Script settle(double content_rad, bool& settled);
  /// How the tool has to be turned: by the numbers in a closed loop, else by cross and triangle.
  [[nodiscard]] std::optional<Deviation> read_rotation() const;
  void rotate_by(Vec3 rotation_rad);
  /// What they do where there is no reading; true when it has been away for so long that those
  /// before it are out of date.
  bool regain_reading(const Aim& aim, double lost_s, double tick_s);
  /// From where the tag of a tool along `axis` is seen well, and the reference's as well.
  [[nodiscard]] Vec3 best_view(Vec3 axis) const {
    return SurgeonBody::best_view(axis, reference_faces_);
  }
  /// Turns the tag to and fro and leans over, so that the cameras find it again.
  void show_tag(const Aim& aim, double since_s, double tick_s);
  /// Leans to either side of `from`, farther and farther.
  void lean(Point<Room> site, Vec3 from, double since_s);
  /// Leans once nothing has been shown for a while, where the system relies on a reference: one tag
  /// may hide the other. Returns whether it does.
  bool lean_where_lost(Point<Room> site, Vec3 from, double lost_s);

  // surgeon_placing.cpp
  /// Measures the wire of the screw that was drilled, and keeps or redoes it.
  Script look_at_wire(std::size_t level, Side side);
  /// Sets the guide's sleeve over it, turns it to and fro and clicks, again if the line says that
  /// the measurement was not taken.
  Script set_sleeve_over(const StepOnDisplay& step, std::size_t level, const StandingWire& wire);

  // surgeon_rod.cpp
  Script touch_heads(Side side);

  [[nodiscard]] const SurgeonPhrases& words() const { return layout_->room().phrases; }
  [[nodiscard]] bool sees_now() const;
  /// The step that the status line names, which must exist.
  [[nodiscard]] const StepOnDisplay& step_now() const { return eyes_.status()->at; }
  [[nodiscard]] bool in_step(const StepOnDisplay& step) const {
    return eyes_.status() && step_now() == step;
  }
  void give_up();

  const RoomLayout* layout_;
  const ErrorModel* error_model_;
  Eyes eyes_;
  RetainedImplants metal_;
  SurgeonBody body_;
  GuidanceProfile guidance_;
  bool relies_on_reference_;  ///< two tags are needed, of which one may hide the other
  std::optional<Vec3> reference_faces_;
  Vec3 misread_rad_{};  ///< of the angle; drawn before the wire goes in, constant while it does
  Bearings bearings_;
  Random checking_;  ///< a separate stream: without touches, the others stay the same
  Random seating_;   ///< of the tip in a landmark; a separate stream too
  Random sleeving_;  ///< of the sleeve over a wire; a separate stream too
  double lightness_ = 1.0;
  std::vector<std::vector<StrokeRegion>> regions_;  ///< for each level; empty where not operated
  bool refused_ = false;                            ///< the registration of what was stroked
  std::vector<int> failures_;                       ///< refusals and rejections, for each level
  std::vector<std::optional<BoneSpot>> landmarks_;  ///< in Vertebra, for each level
  std::vector<int> moved_;  ///< how often its landmark had moved since a level was registered
  std::set<StepOnDisplay> redone_;  ///< guide steps whose wire was taken out once
  std::set<StepOnDisplay> driven_;  ///< guide steps whose wire is in
  bool finished_ = false;
  bool gave_up_ = false;
  Script life_;
};

}  // namespace orthonav::sim
