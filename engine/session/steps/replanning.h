#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/time.h"
#include "engine/session/log/operation_json.h"
#include "engine/session/replan.h"
#include "engine/session/session_state.h"
#include "engine/session/text/status_line.h"
#include "nav/guidance/screw.h"
#include "nav/registration/registration.h"

namespace orthonav::engine {

/// The screw as changed, or why the change is refused; the clearance to the cortex is not checked.
[[nodiscard]] std::variant<nav::ScrewPlan, ReplanRefusal> changed(
    const Replan& replan, const nav::ScrewPlan& now, const nav::ScrewPlan& preoperative,
    const nav::VertebraModel& bone, const ReplanLimits& limits);

class Guiding;
class Placing;

/// Changes a planned screw while it is operated on (docs/decisions/0071-the-plan-in-use.md). The
/// plan in use is `LevelState::plan`; the preoperative plan is kept beside it, and so is every plan
/// that was in use in between.
class Replanning {
 public:
  explicit Replanning(ReplanLimits limits) : limits_(std::move(limits)) {}

  /// Sets what the next `change` is to do.
  void ask(Replan replan) { asked_ = std::move(replan); }
  /// Applies it to the current screw: the next one in `landmark`, the selected one in `guide`, and
  /// in `measure` one whose wire waits for a decision. Otherwise says why not; a change that would
  /// leave the cortex waits for consent. The level has a registration.
  void replan(SessionState& work, Guiding& guiding, Placing& placing, Timestamp time);
  /// A frame with this message, null for none, is displayed at `display_time`.
  void show(const Message* message, Timestamp display_time);
  /// Whether a breach of the current screw may be taken by what was said then: after the question
  /// was shown, and before it expired.
  [[nodiscard]] bool pending(const SessionState& work, const Guiding& guiding,
                             const Placing& placing, Timestamp said) const;
  /// Makes the pending change.
  void take_breach(SessionState& work, Guiding& guiding, Placing& placing, Timestamp time);
  void withdraw_question() { question_.reset(); }

 private:
  using Outcome = std::variant<ScrewReplanned, ReplanRefusal>;
  struct Question {
    std::string level;
    std::size_t screw = 0;
    nav::ScrewPlan plan;
    std::optional<Timestamp> shown_at;
  };
  [[nodiscard]] Outcome change(LevelState& level, std::size_t screw);
  [[nodiscard]] Outcome undo(LevelState& level, std::size_t screw) const;
  /// Reports the outcome, and applies it to guidance and to the wire's assessment.
  void take(const Outcome& outcome, SessionState& work, Guiding& guiding, Placing& placing,
            Timestamp time) const;

  ReplanLimits limits_;
  Replan asked_;
  std::optional<Question> question_;
};

/// Makes another entry beside the hole of a screw's first wire the plan in use. There is no way
/// back to the hole; its plan is kept as the only earlier plan.
void put_other_entry(LevelState& level, std::size_t screw, Point<Vertebra> entry);

// Its records in the log; `json` holds time and level already.

/// The plan of every screw, with the reason for each accepted breach; `why`: for what it changed.
void log_plan(LogJson& json, const LevelState& level, const std::string& why);
void read_plan(const JsonNode& node, LevelState& level);

// Changes of a screw in words.

/// "6.0 × 45 mm"; "45 mm long" if no diameter is stated.
void append_size(std::string& out, double diameter_m, double length_m);
/// "entry moved 1.0 mm cranial, aims 2.0° more medial, 6.0 × 45 mm instead of 5.5 × 40 mm"; "no
/// difference" if all of it rounds to zero.
[[nodiscard]] std::string text_of(const nav::ScrewDifference& difference);
/// What the surgeon asked for: "move cranial 1.0 mm", "undo".
[[nodiscard]] std::string text_of(const Replan& replan);

void write(PartedText text, const ReplanRefusal& refusal);
void write(PartedText text, const ScrewReplanned& done);

}  // namespace orthonav::engine
