#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "engine/session/operation_in_work.h"

namespace orthonav::engine {

/// Whether the plan has a rod on that side: two screws or more.
[[nodiscard]] bool rod_planned(std::span<const LevelState> levels, nav::Side side);
/// On any.
[[nodiscard]] bool any_rod_planned(std::span<const LevelState> levels);

/// The step in which the heads of the screws are touched, the left rod's, then the right one's, and
/// a rod is bent through them. A side without a rod in the plan is passed over.
class RodTemplating {
 public:
  RodTemplating(bool left_planned, bool right_planned);

  /// The first rod, or the next one: a press from before it is no touch of its heads.
  void begin() { touch_ = {}; }
  void begin_touch() { touch_.begin(); }
  void end_touch() { touch_.release(); }
  void drop_touch(OperationInWork& work, Timestamp time);
  /// Once for each pair of the step.
  void collect(const WatchedTools& tools) { add_tip(touch_, tools, tools.pointer()); }
  /// The place that was touched is the next head.
  void record_head(OperationInWork& work, Timestamp time);
  /// Takes the last one back.
  void drop_head(OperationInWork& work, Timestamp time);
  /// The rod is done; false when no other is left to do.
  bool finish();
  [[nodiscard]] Event finish_rod(OperationInWork& work, Timestamp time);
  void move_away() { moved_away_ = !moved_away_; }
  /// Marks the rods that a resumed operation has finished; they are not shown.
  void restore(const std::array<bool, 2>& done);
  /// Whether a planned rod is still to be done.
  [[nodiscard]] bool left_to_do() const { return planned_[current_] && !rods_[current_].done; }
  /// A finished rod stays in the report, shown nowhere; one under way begins anew.
  void forget_map();

  [[nodiscard]] const RodState& current() const { return rods_[current_]; }
  [[nodiscard]] std::span<const RodState> rods() const { return rods_; }
  void write(Guidance& out) const;
  [[nodiscard]] HeadsSoFar state() const;

 private:
  [[nodiscard]] RodState& rod() { return rods_[current_]; }
  /// Makes the template of the heads as they are now, and the instructions to bend it, or says why
  /// they give no template. How deep the rod lies below a head follows the nearest screw of this
  /// side among the registered levels.
  void bend(OperationInWork& work, Timestamp time);
  void instruct(const SessionOptions& options, std::span<const LevelState> levels);

  std::array<RodState, 2> rods_;  ///< left, right
  std::array<bool, 2> planned_;
  std::size_t current_ = 0;
  bool moved_away_ = false;
  Touch touch_;
};

}  // namespace orthonav::engine
