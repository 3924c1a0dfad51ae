#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "hal/sim/sim_headset.h"
#include "study/surgeon/scripted_surgeon.h"
#include "tests/hal/sim/test_rooms.h"

namespace orthonav::sim {

/// A level's digitization as seen from outside.
struct DigitizedLevel {
  double duration_s = 0.0;  ///< from the first press to the double click
  int saved_samples = 0;
  int deleted_regions = 0;
  std::vector<Vec3> samples_in_vertebra;   ///< saved ones
  std::vector<Vec3> checks_in_vertebra;    ///< touched in `verify`
  std::vector<Vec3> landmark_in_vertebra;  ///< touched in `landmark`
  /// The guide in `measure`, when it was clicked: its tip, and its direction into the bone.
  std::vector<std::pair<Vec3, Vec3>> sleeves_in_vertebra;
};

struct EngineOptions {
  int refusals = 0;           ///< of each level, before it is accepted
  bool enough = false;        ///< said of a level's strokes from the first ones on
  Vec3 registration_error_m;  ///< shifts every hologram of the bone, in Room
  /// Turns them about the vertebra's origin, before the shift; a rotation vector in Room.
  Vec3 registration_rotation_rad;
  /// A leak, planted: the surgeon perceives the bones as they are, whatever the engine knows.
  bool peeks = false;
  double blind_from_s = 0.0;  ///< the tools are lost in this span of time
  double blind_to_s = 0.0;
  /// Nothing of a screw is shown unless the head has turned this far about the vertical since the
  /// screw's step began: one tag hides another.
  double shown_aside_rad = 0.0;
  bool deaf = false;     ///< hears no voice
  int lost_touches = 0;  ///< the first touches are not recorded
  int check_points = 0;  ///< asked for in `verify`
  /// Shown as the place to be touched next in every `verify`; in Vertebra.
  std::optional<Vec3> place_to_touch;
  bool off = false;             ///< the touched places turn out too far off
  bool landmark = false;        ///< asked for in `landmark`, before every screw
  bool wire = false;            ///< measured in `measure`, after every screw
  int wires_off = 0;            ///< this many of them are reported beyond a limit
  bool no_other_entry = false;  ///< there is no other entry through which they could be redone
  int landmark_moves = 0;  ///< this many touches before a level's second screw find it elsewhere
};

/// The index of the room's first tool of that kind.
std::size_t tool_of(const RoomDescription& room, ToolKind kind);

/// For a simulation that renders nothing, for tests that need no images.
SimOptions without_pixels(std::uint64_t seed, const ErrorModel& error_model = {});

/// Stands in for the engine: follows the workflow by clicker and voice, and draws from the truth
/// the holograms that an engine without errors would draw.
class FakeEngine {
 public:
  FakeEngine(SimHeadset& headset, const TestCase& test_case, EngineOptions options = {});
  /// Called after each frame with the step of the workflow.
  std::function<void(const StereoFrame&, const StepOnDisplay&)> on_frame;
  /// Runs the headset to the end of its stream; the number of frames.
  int run();

  [[nodiscard]] const std::map<std::string, DigitizedLevel>& levels() const { return levels_; }
  [[nodiscard]] const std::vector<std::string>& history() const { return history_; }
  [[nodiscard]] const std::vector<ClickerEvent>& clicks() const { return clicks_; }
  [[nodiscard]] const std::vector<Phrase>& phrases() const { return phrases_; }
  [[nodiscard]] const std::vector<Point<World>>& heads() const { return heads_; }
  /// The pose of a level as its holograms show it, in the true level's frame.
  [[nodiscard]] Transform<Vertebra, Vertebra> vertebra_from_shown(const std::string& label) const;

 private:
  void take(const ClickerEvent& event);
  void take(const Phrase& phrase);
  void enter(const StepOnDisplay& step);
  void double_clicked(Timestamp time);
  void touched();
  void ask_for_checks();
  [[nodiscard]] Point<World> tip() const;
  void touched_landmark();
  void measured_wire();
  void answer_about_wire(const std::string& phrase);
  void look_at_wire();
  void next_screw();
  /// Adds where the pointer's tip is to the stroke, while one is made.
  void sample();
  void draw(const StereoFrame& frame);
  void draw_vertebra(ShownFrame& shown) const;
  [[nodiscard]] bool is_hidden(const RoomState& state);
  void draw_screw(ShownFrame& shown, const RoomState& state, bool blind) const;
  void draw_guide(ShownFrame& shown, Point<World> entry, Vec3 outwards,
                  const RoomState& state) const;
  [[nodiscard]] std::string level_label() const { return order_[level_]; }
  [[nodiscard]] Transform<Room, Vertebra> room_from_vertebra(const std::string& label) const;
  [[nodiscard]] Transform<Room, Vertebra> room_from_shown(const std::string& label) const;
  [[nodiscard]] Transform<World, Vertebra> world_from_vertebra(const std::string& label) const;
  [[nodiscard]] const RoomLevel& level_named(const std::string& label) const;

  SimHeadset& headset_;
  const TestCase& case_;
  EngineOptions options_;
  std::vector<std::string> order_;
  std::size_t level_ = 0;
  std::size_t screw_ = 0;
  bool guided_here_ = false;  ///< `screw_` is one of this level
  StepOnDisplay step_;
  std::optional<Vec3> view_at_first_;  ///< of the screw's step
  Notice notice_ = Notice::kNone;
  ChecksAsked checks_ = ChecksAsked::kNone;
  bool pressed_ = false;
  int attempts_ = 0;
  std::optional<Timestamp> first_press_;
  std::vector<Vec3> region_;
  std::map<std::string, DigitizedLevel> levels_;
  std::vector<Point<World>> heads_;
  std::vector<std::string> history_{"setup"};
  std::vector<ClickerEvent> clicks_;
  std::vector<Phrase> phrases_;
};

}  // namespace orthonav::sim
