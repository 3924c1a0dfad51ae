#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "engine/session/operation_in_work.h"
#include "nav/registration/digitizer.h"

namespace orthonav::engine {

/// Measures a rod while it is bent, part of the step `rod`. "next" says that the rod lies still to
/// be stroked: first straight, then after each bend. "save" measures what was stroked, and says
/// what is left to bend; "delete" goes back step by step, at last to touching heads.
class RodMeasuring {
 public:
  /// A rod is being measured, so presses are strokes, not touches of heads.
  [[nodiscard]] bool on() const { return made_.has_value(); }
  /// The last measurement showed that the rod can't be brought to its seats any more.
  [[nodiscard]] bool given_up() const { return lost_.has_value(); }
  /// The button, while `on`.
  void button(Action action, Timestamp time);
  /// Once for each pair while `on`.
  void collect(const WatchedTools& tools);

  /// The rod is straight, or its next bend is made: it is stroked next.
  void next(RodState& rod, OperationInWork& work, Timestamp time);
  /// Measures the stroked rod. Whatever is refused changes nothing.
  void save(RodState& rod, OperationInWork& work, Timestamp time);
  /// Drops the strokes; without any, goes back to what was before them.
  void drop(RodState& rod, OperationInWork& work, Timestamp time);
  /// Its rod is measured no more: another is next, or its heads or World have changed.
  void forget() { *this = RodMeasuring{}; }

  [[nodiscard]] std::span<const nav::Region> strokes() const { return strokes_.regions(); }
  [[nodiscard]] RodInHandSoFar state(const RodState& rod) const;

 private:
  /// A rod as it was before it was given up.
  struct Lost {
    nav::RodInstructions instructions;
    std::vector<RodBendInHand> measured;
  };
  /// The measured rod as it lies; nothing if it was refused.
  [[nodiscard]] std::optional<LyingRod> measured(RodState& rod, OperationInWork& work,
                                                 std::span<const Vec3> points_m, Timestamp time);
  [[nodiscard]] std::optional<LyingRod> measured_after_bend(RodState& rod, OperationInWork& work,
                                                            std::span<const Vec3> points_m,
                                                            Timestamp time);
  void give_up(RodState& rod, OperationInWork& work, const Error& why, Timestamp time);
  void stroke_next(RodState& rod, std::size_t made);

  std::optional<std::size_t> made_;  ///< bends of the rod in hand, as the surgeon says
  bool stroking_ = false;            ///< it is to be stroked; otherwise it was
  nav::Digitizer strokes_;
  std::optional<Lost> lost_;
};

}  // namespace orthonav::engine
