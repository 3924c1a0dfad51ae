#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "engine/session/operation_in_work.h"
#include "nav/guidance/rod_cut.h"

namespace orthonav::engine {

/// Whether the plan has a rod on that side: two screws or more.
[[nodiscard]] bool rod_planned(std::span<const LevelState> levels, nav::Side side);
/// Whether the plan has a rod on any side.
[[nodiscard]] bool any_rod_planned(std::span<const LevelState> levels);

/// The step in which the heads of the screws are touched, first of the left rod, then of the right
/// one, and a rod is bent through them. A side without a rod in the plan is skipped; without a plan
/// neither is.
class RodTemplating {
 public:
  RodTemplating(bool left_planned, bool right_planned);

  /// Begins the first rod or the next one; an earlier press does not count as a touch of its heads.
  /// `kNoSideLeft` if all were done before the operation was resumed.
  [[nodiscard]] std::optional<Event> begin();
  void begin_touch() { touch_.begin(); }
  void end_touch() { touch_.release(); }
  void drop_touch(OperationInWork& work, Timestamp time);
  /// Once for each pair of the step.
  void collect(const WatchedTools& tools);
  /// Records the touched place as the next head, or as one more touch of the head it is at.
  void record_head(OperationInWork& work, Timestamp time);
  /// Takes the last touch back.
  void drop_head(OperationInWork& work, Timestamp time);
  /// The rod is done; false if no other is left to do.
  bool finish();
  [[nodiscard]] Event finish_rod(OperationInWork& work, Timestamp time);
  void move_away() { moved_away_ = !moved_away_; }
  /// Marks the rods that a resumed operation has finished; they are not shown.
  void restore(const std::array<bool, 2>& done);
  /// Whether a planned rod is still to be done.
  [[nodiscard]] bool left_to_do() const { return planned_[current_] && !rods_[current_].done; }
  /// A finished rod stays in the report but is no longer shown; an unfinished one begins anew.
  void forget_map();

  [[nodiscard]] const RodState& current() const { return rods_[current_]; }
  [[nodiscard]] std::span<const RodState> rods() const { return rods_; }
  void write(Guidance& out) const;
  /// `unplanned`: no plan says which sides have a rod.
  [[nodiscard]] HeadsSoFar state(bool unplanned) const;

 private:
  [[nodiscard]] RodState& rod() { return rods_[current_]; }
  /// Makes the template from the present heads, and the instructions to bend it, or says why there
  /// is no template.
  void bend(OperationInWork& work, Timestamp time);
  void instruct(const SessionOptions& options, std::span<const LevelState> levels);
  /// Where the rod lies below the touched heads: along the nearest screw of this side among the
  /// registered levels; where rods alone are bent, to where the pointer pointed.
  [[nodiscard]] Result<nav::RodCut> seats(const SessionOptions& options,
                                          std::span<const LevelState> levels, double overhang_m);
  /// Says of the instructed rod how surely it will lie in the true heads.
  void expect();

  std::array<RodState, 2> rods_;  ///< left, right
  std::array<bool, 2> planned_;
  std::size_t current_ = 0;
  bool moved_away_ = false;
  Touch touch_;
};

}  // namespace orthonav::engine
