#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/time.h"
#include "engine/session/guidance.h"
#include "engine/session/replan.h"
#include "engine/session/replan_limits.h"

namespace orthonav::engine {

/// Changes a planned screw while it is operated on (docs/decisions/0071-the-plan-in-use.md). The
/// plan in use is `LevelState::plan`; what was planned before surgery stays beside it, and so does
/// every plan that was in use in between.
class Replanning {
 public:
  using Outcome = std::variant<ScrewReplanned, ReplanRefusal>;

  explicit Replanning(ReplanLimits limits = {}) : limits_(std::move(limits)) {}

  /// What is to be changed with the next `change`.
  void ask(Replan replan) { asked_ = std::move(replan); }
  /// Does it to a screw of a level that has a registration, or says why not. A screw that would
  /// leave the cortex waits for consent.
  [[nodiscard]] Outcome change(LevelState& level, std::size_t screw);
  /// A frame that shows the question is displayed then.
  void show(Timestamp display_time);
  /// Takes the change that waits, where the surgeon said so after the question was shown and no
  /// longer than `within` after. None: nothing waits.
  [[nodiscard]] std::optional<Outcome> consent(LevelState& level, std::size_t screw, Timestamp said,
                                               Duration within);
  void withdraw_question() { question_.reset(); }
  /// What was asked for last.
  [[nodiscard]] const Replan& asked() const { return asked_; }

 private:
  struct Question {
    std::string level;
    std::size_t screw = 0;
    nav::ScrewPlan plan;
    std::optional<Timestamp> shown_at;
  };
  [[nodiscard]] Outcome undo(LevelState& level, std::size_t screw) const;

  ReplanLimits limits_;
  Replan asked_;
  std::optional<Question> question_;
};

/// Another entry beside the hole of a screw's first wire becomes the plan in use. There is no way
/// back to the hole: what was planned for it is kept, as the one earlier plan.
void put_other_entry(LevelState& level, std::size_t screw, Point<Vertebra> entry);

/// The screw as it would be, or why it may not be so; the cortex is not looked at.
[[nodiscard]] std::variant<nav::ScrewPlan, ReplanRefusal> changed(
    const Replan& replan, const nav::ScrewPlan& now, const nav::ScrewPlan& preoperative,
    const nav::VertebraModel& bone, const ReplanLimits& limits);

}  // namespace orthonav::engine
