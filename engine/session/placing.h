#pragma once

#include <optional>
#include <vector>

#include "engine/session/axis_touch.h"
#include "engine/session/operation_in_work.h"
#include "engine/session/raised.h"
#include "engine/session/tool_in_vertebra.h"
#include "nav/calibration/spin.h"
#include "nav/guidance/other_entry.h"

namespace orthonav::engine {

class GuideChecks;
class Guiding;

/// The step `placed`: the sleeve is set over the wire, and what is measured is kept or redone. A
/// sleeve that was turned to and fro on the wire before the click tells the wire's direction
/// without the guide's own axis, and that axis as well. Another wire is another object.
class Placing {
 public:
  explicit Placing(const SessionOptions& options);

  void begin_touch() { touch_.begin(); }
  void end_touch() { touch_.release(); }
  void drop_touch(OperationInWork& work, Timestamp time);
  /// Once for each pair of the step.
  void collect(const WatchedTools& tools);
  /// The wire of the selected screw as the touch has it, or why it does not count. The level has a
  /// registration. `reference_hidden`: no patient reference is seen, where one is in use.
  void measure(OperationInWork& work, const Guiding& guiding, GuideChecks& checks,
               bool reference_hidden, Timestamp time);
  [[nodiscard]] Event judge_wire() const {
    return undecided() ? Event::kWireUndecided : Event::kWireSettled;
  }
  /// The surgeon says so, of a wire beyond a limit.
  void keep(OperationInWork& work, std::size_t screw, Timestamp time);
  /// Another entry for the same screw, whose landmark is touched before: what drove the wire astray
  /// may have moved the bone against its registration.
  [[nodiscard]] std::optional<Raised> judge_redo(OperationInWork& work, Guiding& guiding,
                                                 Timestamp time);
  /// The plan was changed: the wire, which was measured, is held against that one.
  void judge_again(OperationInWork& work, std::size_t screw, Timestamp time);

  /// As it was measured last.
  [[nodiscard]] const std::optional<PlacedWire>& wire() const { return wire_; }
  [[nodiscard]] bool undecided() const { return wire_ && wire_->undecided(); }
  void write(Step step, Guidance& out) const;
  [[nodiscard]] StepState state() const;

 private:
  /// The sleeve as it stood.
  struct Measured {
    nav::Axis<Vertebra> sleeve;
    nav::PoseUncertainty uncertainty;
    nav::SleeveErrors errors;
    std::size_t pairs = 0;
  };
  /// Pairs in which the guide was measured: ten seconds at 30 a second.
  static constexpr std::size_t kMostRecent = 300;

  [[nodiscard]] std::optional<TouchRefusal> take(const OperationInWork& work, std::size_t screw,
                                                 const ToolErrors& guide_errors);
  /// The wire, as it was measured, by its axis against a plan.
  void put(const nav::PlacedAxis& axis);
  void tell(OperationInWork& work, std::size_t screw, Timestamp time) const;
  /// Whether "delete" has to be said again: a screw is redone once without.
  [[nodiscard]] bool must_confirm(int redone);
  /// Where the screw may enter instead of through the wire's hole; it was measured. Remembers where
  /// there is no such place.
  [[nodiscard]] std::optional<nav::OtherEntry> other_entry(const LevelState& level,
                                                           std::size_t screw);
  void use_turning(const nav::ToolGeometry& guide, RestingAxis& resting);
  [[nodiscard]] std::optional<TouchRefusal> refusal_of(const nav::PlacedAxis& axis) const;

  PlacedWireRules rules_;
  /// False: no wire is redone; one beyond a limit is kept by a word, or its level rejected.
  bool redo_ = true;
  std::optional<PlacedWire> wire_;
  std::optional<Measured> measured_;  ///< that `wire_` is made of
  bool no_other_entry_ = false;
  bool confirming_ = false;
  AxisTouch touch_;
  std::vector<Transform<World, Marker>> recent_;  ///< of the guide, the oldest first
  /// What the sleeve turned about, where it was turned for the measurement.
  std::optional<nav::SpinCalibration> spin_;
};

}  // namespace orthonav::engine
