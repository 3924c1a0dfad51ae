#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/time.h"
#include "engine/session/operation_in_work.h"
#include "engine/session/replanned_screw.h"

namespace orthonav::engine {

class Guiding;
class Placing;

/// Changes a planned screw while it is operated on (docs/decisions/0071-the-plan-in-use.md). The
/// plan in use is `LevelState::plan`; what was planned before surgery stays beside it, and so does
/// every plan that was in use in between.
class Replanning {
 public:
  explicit Replanning(ReplanLimits limits) : limits_(std::move(limits)) {}

  /// What is to be changed with the next `change`.
  void ask(Replan replan) { asked_ = std::move(replan); }
  /// Does it to the screw in work: the next one in `accepted`, the selected one in `guide`, and in
  /// `placed` one whose wire waits for a word. Or says why not; one that would leave the cortex
  /// waits for consent. The level has a registration.
  void replan(OperationInWork& work, Guiding& guiding, Placing& placing, Timestamp time);
  /// A frame that shows the question is displayed then.
  void show(Timestamp display_time);
  /// Takes the change that waits, where the surgeon said so after the question was shown and no
  /// longer after than it stands. False: nothing waits.
  [[nodiscard]] bool consent(OperationInWork& work, Guiding& guiding, Placing& placing,
                             Timestamp said);
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
  /// None: no question about this screw was shown, or it no longer stands.
  [[nodiscard]] std::optional<Outcome> consented(LevelState& level, std::size_t screw,
                                                 Timestamp said, Duration within);
  /// What became of it is said, and holds for what is guided and judged.
  void take(const Outcome& outcome, OperationInWork& work, Guiding& guiding, Placing& placing,
            Timestamp time) const;

  ReplanLimits limits_;
  Replan asked_;
  std::optional<Question> question_;
};

/// Another entry beside the hole of a screw's first wire becomes the plan in use. There is no way
/// back to the hole: what was planned for it is kept, as the one earlier plan.
void put_other_entry(LevelState& level, std::size_t screw, Point<Vertebra> entry);

}  // namespace orthonav::engine
