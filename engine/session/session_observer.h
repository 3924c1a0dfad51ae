#pragma once

#include <span>
#include <string_view>

#include "engine/session/calibration_in_use.h"
#include "engine/session/guidance.h"
#include "engine/session/registration_outcome.h"
#include "engine/session/request.h"
#include "hal/api/devices.h"
#include "nav/guidance/other_entry.h"

namespace orthonav::engine {

/// Hears what happens in a session, in order, on the thread that steps it. The references live as
/// long as the call.
class SessionObserver {
 public:
  virtual ~SessionObserver() = default;
  /// Every event with the table's answer to it.
  virtual void happened(Timestamp /*time*/, Step /*from*/, Event /*event*/, Cell /*answer*/) {}
  /// Another program asks; what it leads to is heard next.
  virtual void asked_from_outside(const Request& /*request*/) {}
  /// A phrase that is no command here, or was not understood well enough.
  virtual void not_understood(const Phrase& /*phrase*/) {}
  /// A region was saved: the last of the level's.
  virtual void region_saved(Timestamp /*time*/, const LevelState& /*level*/,
                            const nav::Region& /*region*/) {}
  /// The last of the level's saved regions was deleted.
  virtual void region_dropped(Timestamp /*time*/, const LevelState& /*level*/) {}
  /// The level is stroked anew: its regions and its registration are gone.
  virtual void level_cleared(Timestamp /*time*/, const LevelState& /*level*/) {}
  /// Its landmark has moved: its registration is verified once more.
  virtual void acceptance_withdrawn(Timestamp /*time*/, const LevelState& /*level*/) {}
  /// World is another one: whatever was measured in it is gone, but for what is in the patient.
  virtual void places_forgotten(Timestamp /*time*/) {}
  /// Where the patient references in use lie in World, whenever that changes.
  virtual void references_placed(Timestamp /*time*/,
                                 std::span<const nav::ReferencePlace> /*places*/) {}
  /// A registration was asked for.
  virtual void registered(Timestamp /*time*/, const LevelState& /*level*/,
                          const RegistrationOutcome& /*outcome*/) {}
  /// A place was touched to verify the level's registration: the last of its check points.
  virtual void check_point_recorded(Timestamp /*time*/, const LevelState& /*level*/) {}
  /// The last of them was taken back; `level` is without it.
  virtual void check_point_dropped(Timestamp /*time*/, const LevelState& /*level*/) {}
  /// The surgeon accepted the level's registration, which holds what was touched on it by now.
  /// `shown` is the status line that they were shown before they did.
  virtual void accepted(Timestamp /*time*/, const LevelState& /*level*/,
                        std::string_view /*shown*/) {}
  /// The level's landmark was touched: for the first time, or against where it was then.
  virtual void landmark_touched(Timestamp /*time*/, const LevelState& /*level*/,
                                const LandmarkTouch& /*touch*/) {}
  /// The guide's tip was put into the landmark after the pointer's, or corrected by it.
  virtual void tips_compared(Timestamp /*time*/, const TipDifference& /*difference*/) {}
  virtual void axis_compared(Timestamp /*time*/, const AxisDifference& /*difference*/) {}
  /// That touch was taken back; with a first one, the landmark.
  virtual void landmark_dropped(Timestamp /*time*/, const LevelState& /*level*/) {}
  /// The wire of that screw was measured, or is kept as it was measured.
  virtual void wire_measured(Timestamp /*time*/, const LevelState& /*level*/, std::size_t /*screw*/,
                             const PlacedWire& /*wire*/) {}
  /// That screw is redone; its plan has another entry by now.
  virtual void screw_redone(Timestamp /*time*/, const LevelState& /*level*/, std::size_t /*screw*/,
                            const nav::OtherEntry& /*entry*/) {}
  /// The surgeon changed a planned screw, or took a change back.
  virtual void replanned(Timestamp /*time*/, const LevelState& /*level*/, const Replan& /*asked*/,
                         const ScrewReplanned& /*done*/) {}
  /// The surgeon declared the screw done; `at_depth` is what was measured last while the tool stood
  /// at its depth, or null where it never did.
  virtual void screw_done(Timestamp /*time*/, const LevelState& /*level*/, std::size_t /*screw*/,
                          const ToolGuidance* /*at_depth*/) {}
  /// What tags and cameras in use have told so far, after each screw.
  virtual void calibration_found(Timestamp /*time*/, const CalibrationInUse& /*found*/) {}
  virtual void head_recorded(Timestamp /*time*/, nav::Side /*side*/, Point<World> /*head*/) {}
  virtual void head_dropped(Timestamp /*time*/, nav::Side /*side*/) {}
  virtual void rod_done(Timestamp /*time*/, const RodState& /*rod*/) {}
};

}  // namespace orthonav::engine
