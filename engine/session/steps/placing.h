#pragma once

#include <optional>
#include <vector>

#include "engine/session/log/operation_json.h"
#include "engine/session/session_state.h"
#include "engine/session/text/messages.h"
#include "engine/session/text/status_line.h"
#include "engine/session/tool_in_vertebra.h"
#include "engine/session/touch.h"
#include "nav/calibration/spin.h"
#include "nav/guidance/other_entry.h"

namespace orthonav::engine {

class GuideChecks;
class Guiding;

/// The step `measure`: the wire is measured with the sleeve over it, and kept or redone. Turning
/// the sleeve to and fro on the wire before the click gives the wire's direction independently of
/// the guide's described axis, and measures that axis too. A new object is made for each wire.
class Placing {
 public:
  explicit Placing(const SessionOptions& options);

  /// Once for each pair of the step.
  void collect(SessionState& work);
  /// Measures the wire of the selected screw by what was touched, or says why that does not count.
  /// The level has a registration. `reference_hidden`: none is seen, where one is in use.
  void measure(SessionState& work, const Guiding& guiding, GuideChecks& checks,
               bool reference_hidden, Timestamp time);
  /// The surgeon keeps a wire that lies beyond a limit, undecided so far.
  void keep(SessionState& work, std::size_t screw, Timestamp time);
  /// Another entry for the same screw. The landmark is touched first: whatever deflected the wire
  /// may have moved the bone against its registration.
  [[nodiscard]] std::optional<FollowUpEvent> judge_redo(SessionState& work, Guiding& guiding,
                                                        Timestamp time);
  /// The plan was changed: the measured wire is compared with the new plan.
  void judge_again(SessionState& work, std::size_t screw, Timestamp time);

  /// The wire as last measured.
  [[nodiscard]] const std::optional<PlacedWire>& wire() const { return wire_; }
  /// Measured beyond a limit, and neither kept nor redone.
  [[nodiscard]] bool undecided() const { return wire_ && wire_->undecided(); }
  void write(Step step, Guidance& out) const;
  [[nodiscard]] StepState state() const;

 private:
  /// The sleeve as measured.
  struct Measured {
    nav::Axis<Vertebra> sleeve;
    nav::PoseUncertainty uncertainty;
    nav::SleeveErrors errors;
    std::size_t pairs = 0;
  };
  /// Pairs in which the guide was measured: ten seconds at 30 a second.
  static constexpr std::size_t kMostRecent = 300;

  [[nodiscard]] std::optional<TouchRefusal> take(SessionState& work, std::size_t screw,
                                                 const ToolErrors& guide_errors);
  /// Sets the measured wire, with its axis relative to a plan.
  void put(const nav::PlacedAxis& axis);
  void tell(SessionState& work, std::size_t screw, Timestamp time) const;
  /// Whether "delete" must be said again: a screw's first redo needs no confirmation.
  [[nodiscard]] bool must_confirm(int redone);
  /// Where the screw may enter instead of through the hole of the wire, which was measured.
  /// Remembers if there is no such place.
  [[nodiscard]] std::optional<nav::OtherEntry> other_entry(const LevelState& level,
                                                           std::size_t screw);
  void use_turning(const nav::ToolGeometry& guide, RestingAxis& resting);
  [[nodiscard]] std::optional<TouchRefusal> refusal_of(const nav::PlacedAxis& axis) const;

  PlacedWireRules rules_;
  /// False: no wire is redone; one beyond a limit is kept on request, or its level rejected.
  bool redo_ = true;
  std::optional<PlacedWire> wire_;
  std::optional<Measured> measured_;  ///< from which `wire_` is computed
  bool no_other_entry_ = false;
  bool confirming_ = false;
  std::vector<Transform<World, Marker>> recent_;  ///< poses of the guide, the oldest first
  /// The axis about which the sleeve was turned for the measurement, if it was.
  std::optional<nav::SpinCalibration> spin_;
};

// Its records in the log; `json` holds time and level already.

/// A wire that is kept beyond a limit is an override: the record holds both.
void log_wire(LogJson& json, std::size_t screw, const PlacedWire& wire);
void read_wire(const JsonNode& node, ScrewState& screw);
// Also in the record of the screw.
[[nodiscard]] LogJson json_of(const PlacedWire& wire);
[[nodiscard]] PlacedWire wire_from(const JsonNode& node);

void write(PartedText text, const WireUndecided& m);
void write(PartedText text, const NoOtherEntry& m);
void write(PartedText text, const ConfirmRedo& m);
void write(PartedText text, const ScrewRedone& m);
/// "angle 2.6°, limit 2.0°: say accept result to keep it, delete last to redo it".
void write_wire(PartedText text, const WireSoFar& state, std::string_view separator);

}  // namespace orthonav::engine
