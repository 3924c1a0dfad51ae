#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "engine/session/log/operation_json.h"
#include "engine/session/session_state.h"
#include "engine/session/text/status_line.h"
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
  [[nodiscard]] std::optional<Event> begin(SessionState& work) const;
  /// Records the touched place as the next head, or as one more touch of the head it is at.
  void record_head(SessionState& work, Timestamp time);
  /// Takes the last touch back.
  void drop_head(SessionState& work, Timestamp time);
  /// The rod is done; false if no other is left to do.
  bool finish(OperationState& operation);
  [[nodiscard]] Event finish_rod(SessionState& work, Timestamp time);
  void move_away() { moved_away_ = !moved_away_; }
  /// Passes over the rods that a resumed operation has finished.
  void resume(const OperationState& operation);
  /// Whether a planned rod is still to be done.
  [[nodiscard]] bool left_to_do(const OperationState& operation) const {
    return planned_[current_] && !operation.rods[current_].done;
  }

  /// Of the current rod.
  [[nodiscard]] nav::Side side() const {
    return current_ == 0 ? nav::Side::kLeft : nav::Side::kRight;
  }
  void write(const SessionState& work, Guidance& out) const;
  [[nodiscard]] HeadsSoFar state(const SessionState& work) const;

 private:
  [[nodiscard]] RodState& current(SessionState& work) const { return work.state.rods[current_]; }

  std::array<bool, 2> planned_;  ///< left, right
  std::size_t current_ = 0;
  bool moved_away_ = false;
};

// Its records in the log; `json` holds the time already.

void log_head(LogJson& json, nav::Side side, const HeadTouch& touch);
/// The last touch was taken back: `touch` as it was recorded.
void log_head_dropped(LogJson& json, nav::Side side, const HeadTouch& touch);
/// `dropped`: taken back; `anchored`: to a patient reference.
void read_head(const JsonNode& node, bool dropped, bool anchored, RodState& rod);
/// A rod that is done: of its template and its instructions only what a report has. Its heads are
/// told as they are touched.
void log_rod(LogJson& json, const RodState& rod);
void read_rod(const JsonNode& node, RodState& rod);

/// The next act.
void write_heads(PartedText text, const HeadsSoFar& heads);

}  // namespace orthonav::engine
