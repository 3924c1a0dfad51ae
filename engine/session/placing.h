#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "engine/session/axis_touch.h"
#include "engine/session/guidance.h"
#include "engine/session/placed_wire.h"
#include "engine/session/tool_in_vertebra.h"
#include "engine/session/tool_watch.h"
#include "nav/calibration/spin.h"
#include "nav/guidance/other_entry.h"

namespace orthonav::engine {

/// The step `placed`: the sleeve is set over the wire, and what is measured is kept or redone. A
/// sleeve that was turned to and fro on the wire before the click tells the wire's direction
/// without the guide's own axis, and that axis as well.
class Placing {
 public:
  Placing() { recent_.reserve(2 * kMostRecent); }
  /// `redo` false: no wire is redone; one beyond a limit is kept by a word, or its level rejected.
  explicit Placing(const PlacedWireRules& rules, bool redo = true) : Placing() {
    rules_ = rules;
    redo_ = redo;
  }

  /// A wire was placed: nothing is known of it.
  void begin();
  [[nodiscard]] AxisTouch& touch() { return touch_; }
  /// Takes the guide in this pair, if it was measured.
  void collect(const nav::TrackedPose& pose, const nav::ToolGeometry& guide);
  /// The wire of that screw as the touch has it, or why it does not count. The level has a
  /// registration.
  [[nodiscard]] std::optional<TouchRefusal> take(const LevelState& level, std::size_t screw,
                                                 const nav::TrackedPose& pose,
                                                 const nav::ToolGeometry& guide,
                                                 const ToolErrors& errors, double max_spread_m);
  /// The plan was changed: the wire, which was measured, is held against that one.
  void judge_again(const nav::ScrewPlan& plan);
  /// As it was measured last.
  [[nodiscard]] const std::optional<PlacedWire>& wire() const { return wire_; }
  /// What the sleeve turned about, where it was turned for the measurement.
  [[nodiscard]] const std::optional<nav::SpinCalibration>& spin() const { return spin_; }
  [[nodiscard]] bool undecided() const { return wire_ && wire_->undecided(); }
  /// The surgeon says so.
  void keep() { wire_->kept = true; }

  /// Whether "delete" has to be said again: a screw is redone once without.
  [[nodiscard]] bool must_confirm(int redone);
  /// Where the screw may enter instead of through the wire's hole; it was measured. Remembers where
  /// there is no such place.
  [[nodiscard]] std::optional<nav::OtherEntry> other_entry(const LevelState& level,
                                                           std::size_t screw);
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

  /// The wire, as it was measured, by its axis against a plan.
  void put(const nav::PlacedAxis& axis);
  void use_turning(const nav::ToolGeometry& guide, RestingAxis& resting);
  [[nodiscard]] std::optional<TouchRefusal> refusal_of(const nav::PlacedAxis& axis) const;

  PlacedWireRules rules_;
  bool redo_ = true;
  std::optional<PlacedWire> wire_;
  std::optional<Measured> measured_;  ///< that `wire_` is made of
  bool no_other_entry_ = false;
  bool confirming_ = false;
  AxisTouch touch_;
  std::vector<Transform<World, Marker>> recent_;  ///< of the guide, the oldest first
  std::optional<nav::SpinCalibration> spin_;
};

}  // namespace orthonav::engine
