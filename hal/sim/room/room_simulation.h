#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "hal/api/devices.h"
#include "hal/sim/room/noise.h"
#include "hal/sim/room/room_layout.h"
#include "hal/sim/room/spine_motion.h"
#include "hal/sim/sim_headset.h"
#include "hal/sim/surgeon/drilling.h"
#include "hal/sim/surgeon/head_motion.h"
#include "hal/sim/surgeon/surgeon.h"

namespace orthonav::sim {

/// Simulates everything that moves in the room, in steps of 1/120 s: head, map, tools, surgeon.
/// Keeps the last second, so that moments between the steps can be queried. Not thread-safe.
class RoomSimulation {
 public:
  /// `eyes_in_rig`: the middle between the cameras. The room must have passed `check_room`.
  RoomSimulation(RoomDescription room, const SimOptions& options, Vec3 eyes_in_rig,
                 Timestamp start);
  RoomSimulation(const RoomSimulation&) = delete;
  RoomSimulation& operator=(const RoomSimulation&) = delete;

  /// Simulates until at least `until`.
  void advance(Timestamp until);
  /// Everything at a moment of the last second; `state`'s buffers are reused.
  void state_at(Timestamp time, RoomState& state) const;
  [[nodiscard]] Transform<Room, Rig> room_from_rig(Timestamp time) const;
  [[nodiscard]] Transform<World, Room> world_from_room(Timestamp time) const;
  [[nodiscard]] Transform<World, Rig> world_from_rig(Timestamp time) const {
    return world_from_room(time) * room_from_rig(time);
  }

  [[nodiscard]] const RoomDescription& room() const { return room_; }
  [[nodiscard]] const Truth& truth() const { return truth_; }
  /// A frame that will light up at its display time, drawn for the head pose that the headset
  /// believes in then: a hologram appears where that puts it relative to the true head. A frame
  /// that is not later than those before is left out.
  void show(const WornFrame& frame, const Transform<World, Rig>& believed_world_from_rig);
  /// Clicks and words not yet fetched, in order.
  [[nodiscard]] std::vector<ClickerEvent>& clicks() { return clicks_; }
  [[nodiscard]] std::vector<Phrase>& phrases() { return phrases_; }
  /// When the surgeon had finished, or had given up.
  [[nodiscard]] std::optional<Timestamp> finished_at() const { return finished_at_; }

  static constexpr Duration kStep{8'333'333};

 private:
  struct Around {
    const RoomState& before;
    const RoomState& after;
    double fraction;
  };
  static constexpr std::size_t kKept = 128;

  void step();
  void light_up(Timestamp until);
  void let_surgeon_act(RoomState& now);
  void let_tools_hover(RoomState& now) const;
  void leave_reference(RoomState& now);
  void bump_reference();
  void shift_patient();
  void put(RoomState& state, std::size_t tool, const Grip& grip, std::optional<Vec3> contact,
           bool on_wire = false) const;
  void move_patient(RoomState& now);
  /// How far a level is pushed by the instrument, in Room.
  [[nodiscard]] Vec3 pushed_m(std::size_t level) const;
  [[nodiscard]] Vec3 pushed_m_by(int levels_away) const;
  [[nodiscard]] int rank_at_hand() const;

  // room_simulation_wires.cpp
  [[nodiscard]] Transform<Vertebra, Marker> guide_in(std::size_t level) const;
  [[nodiscard]] Vec3 guide_inwards(std::size_t level) const;
  /// The tool as it is held by a hand that rests on the patient.
  [[nodiscard]] Grip on_patient(const Posture& posture) const;
  /// Advances the wire with the surgeon's hand.
  void drive_wire();
  [[nodiscard]] AdvancingWire pierce(const Drilling& drilling);
  void leave_wire();
  /// Removes the wire of a screw that is replaced by another one.
  void take_wire_out(const std::string& label, Side side);
  [[nodiscard]] double seconds_in(Timestamp time) const { return seconds(time - start_); }
  [[nodiscard]] RoomState& kept(std::size_t number) { return states_[number % kKept]; }
  [[nodiscard]] const RoomState& kept(std::size_t number) const { return states_[number % kKept]; }
  [[nodiscard]] Around around(Timestamp time) const;

  RoomDescription room_;
  ErrorModel error_model_;
  RoomLayout layout_;
  Timestamp start_;
  Random physics_;
  HeadMotion head_;
  MapDrift drift_;
  SmoothNoise3 tremor_m_;
  SmoothNoise3 tremor_rad_;
  SpineMotion spine_;
  // Motion with the breath and on the table, at the newest step, in Room.
  std::vector<Vec3> level_moved_m_;
  std::vector<double> breath_fractions_;  ///< of each level; fixed
  Vec3 back_moved_m_{};
  std::optional<AdvancingWire> wire_;
  Vec3 back_against_level_m_{};  ///< of the back relative to the bone, when the wire pierced it
  /// Set at the first step, with the patient at rest.
  std::optional<Transform<Room, Marker>> room_from_reference_;
  bool relies_on_reference_;
  ReferenceBump bump_;
  Random bumping_;
  PatientShift shift_;
  Random shifting_;
  Vec3 slipped_m_{};  ///< on the table, in Room
  struct Drawn {
    WornFrame frame;
    Transform<World, Rig> believed_world_from_rig;
  };
  /// Frames that have not lit up, the oldest at `first_drawn_`; of more, the oldest are lost.
  static constexpr std::size_t kMostDrawn = 16;  // a quarter of a second at 60 Hz
  std::array<Drawn, kMostDrawn> drawn_;
  std::size_t first_drawn_ = 0;
  std::size_t drawn_count_ = 0;
  Timestamp newest_drawn_ = Timestamp::min();
  Truth truth_;
  int wires_driven_ = 0;
  std::unique_ptr<Surgeon> surgeon_;
  std::vector<RoomState> states_;
  std::size_t steps_ = 0;  ///< steps simulated; the newest state is number steps_ - 1
  std::vector<ClickerEvent> clicks_;
  std::vector<Phrase> phrases_;
  std::optional<Timestamp> finished_at_;
};

}  // namespace orthonav::sim
