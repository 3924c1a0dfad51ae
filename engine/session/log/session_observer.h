#pragma once

#include <span>
#include <string_view>

#include "engine/session/calibration_in_use.h"
#include "engine/session/guidance.h"
#include "engine/session/operation_state.h"
#include "engine/session/workflow/commands.h"
#include "hal/api/devices.h"
#include "nav/guidance/other_entry.h"

namespace orthonav::engine {

/// Notified of what happens in a session, in order, on the thread that steps it. References are
/// valid during the call only.
class SessionObserver {
 public:
  virtual ~SessionObserver() = default;
  /// Every event with the table's answer to it.
  virtual void happened(Timestamp /*time*/, Step /*from*/, Event /*event*/, Cell /*answer*/) {}
  /// Another program made a request; what it causes is reported next.
  virtual void asked_from_outside(const Request& /*request*/) {}
  /// What became of the last request: whether it had an effect, or what the surgeon was told why it
  /// had none; null: it is not a command.
  virtual void request_answered(const Request& /*request*/, bool /*taken*/,
                                const Message* /*why_not*/) {}
  /// A phrase is not a command here, or was not understood well enough.
  virtual void not_understood(const Phrase& /*phrase*/) {}
  /// A region was saved, the last one of the level.
  virtual void region_saved(Timestamp /*time*/, const LevelState& /*level*/,
                            const nav::Region& /*region*/) {}
  /// The last of the level's saved regions was deleted.
  virtual void region_dropped(Timestamp /*time*/, const LevelState& /*level*/) {}
  /// The level is stroked anew: its regions and its registration are gone.
  virtual void level_cleared(Timestamp /*time*/, const LevelState& /*level*/) {}
  /// Its landmark has moved: its registration is verified once more.
  virtual void acceptance_withdrawn(Timestamp /*time*/, const LevelState& /*level*/) {}
  /// World was replaced: everything measured in it is gone, except what is in the patient.
  virtual void places_forgotten(Timestamp /*time*/) {}
  /// Where the patient references in use lie in World, whenever that changes.
  virtual void references_placed(Timestamp /*time*/,
                                 std::span<const nav::ReferencePlace> /*places*/) {}
  /// A registration was asked for.
  virtual void registered(Timestamp /*time*/, const LevelState& /*level*/,
                          const RegistrationOutcome& /*outcome*/) {}
  /// A resumed operation has this registration of an earlier session, and whether it was accepted.
  virtual void registration_restored(Timestamp /*time*/, const LevelState& /*level*/) {}
  /// A place was touched to verify the level's registration: the last of its check points.
  virtual void check_point_recorded(Timestamp /*time*/, const LevelState& /*level*/) {}
  /// The last check point was taken back; `level` no longer has it.
  virtual void check_point_dropped(Timestamp /*time*/, const LevelState& /*level*/) {}
  /// The surgeon accepted the level's registration, which now includes the touched places. `shown`
  /// is the status line displayed before that.
  virtual void accepted(Timestamp /*time*/, const LevelState& /*level*/,
                        std::string_view /*shown*/) {}
  /// The level's landmark was touched, for the first time or to compare it with its recorded place.
  virtual void landmark_touched(Timestamp /*time*/, const LevelState& /*level*/,
                                const LandmarkTouch& /*touch*/) {}
  /// The guide's tip was put into the landmark after the pointer's, or corrected by it.
  virtual void tips_compared(Timestamp /*time*/, const TipDifference& /*difference*/) {}
  virtual void axis_compared(Timestamp /*time*/, const AxisDifference& /*difference*/) {}
  /// The touch of the landmark was taken back, and the landmark with it if the touch recorded it.
  virtual void landmark_dropped(Timestamp /*time*/, const LevelState& /*level*/) {}
  /// The wire of that screw was measured, or is kept as measured.
  virtual void wire_measured(Timestamp /*time*/, const LevelState& /*level*/, std::size_t /*screw*/,
                             const PlacedWire& /*wire*/) {}
  /// That screw is redone; its plan already has the other entry.
  virtual void screw_redone(Timestamp /*time*/, const LevelState& /*level*/, std::size_t /*screw*/,
                            const nav::OtherEntry& /*entry*/) {}
  /// The surgeon changed a planned screw, or took a change back.
  virtual void replanned(Timestamp /*time*/, const LevelState& /*level*/, const Replan& /*asked*/,
                         const ScrewReplanned& /*done*/) {}
  /// The surgeon declared the screw done; `at_depth` is the last measurement while the tool was at
  /// its depth, or null if it never was.
  virtual void screw_done(Timestamp /*time*/, const LevelState& /*level*/, std::size_t /*screw*/,
                          const ToolGuidance* /*at_depth*/) {}
  /// What was learned about tags and cameras in use so far, after each screw.
  virtual void calibration_found(Timestamp /*time*/, const CalibrationInUse& /*found*/) {}
  /// A screw head was touched, for the first time or once more.
  virtual void head_recorded(Timestamp /*time*/, nav::Side /*side*/, const HeadTouch& /*touch*/) {}
  /// The last touch was taken back: `touch` as it was recorded.
  virtual void head_dropped(Timestamp /*time*/, nav::Side /*side*/, const HeadTouch& /*touch*/) {}
  virtual void rod_done(Timestamp /*time*/, const RodState& /*rod*/) {}
};

}  // namespace orthonav::engine
