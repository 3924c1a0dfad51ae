#include "engine/session/session.h"

namespace orthonav::engine {

// The screw in work is changed: the next one in `accepted`, the selected one in `guide`, and in
// `placed` one whose wire waits for a word.

std::variant<std::size_t, ReplanRefusal> Session::screw_to_replan() const {
  using Kind = ReplanRefusal::Kind;
  if (step_ == Step::kGuide) {
    switch (guiding_.drill().phase) {
      case nav::DrillPhase::kAway:
        return guiding_.screw();
      case nav::DrillPhase::kSet:
        return ReplanRefusal{Kind::kDrillSet};
      case nav::DrillPhase::kDrilling:
        return ReplanRefusal{Kind::kDrilling};
    }
  }
  if (step_ == Step::kPlaced) {
    return placing_.undecided() ? std::variant<std::size_t, ReplanRefusal>(guiding_.screw())
                                : ReplanRefusal{Kind::kWireIn};
  }
  const auto open = level().open_screw();
  if (!open) {
    return ReplanRefusal{Kind::kNoScrewLeft};
  }
  return *open;
}

void Session::replan(Timestamp time) {
  const auto screw = screw_to_replan();
  if (const auto* refusal = std::get_if<ReplanRefusal>(&screw)) {
    return take_replan(*refusal, time);
  }
  take_replan(replanning_.change(level(), std::get<std::size_t>(screw)), time);
}

void Session::take_replan(const Replanning::Outcome& outcome, Timestamp time) {
  if (const auto* refusal = std::get_if<ReplanRefusal>(&outcome)) {
    return messages_.say(*refusal, time);
  }
  const auto& done = std::get<ScrewReplanned>(outcome);
  messages_.say(done, time);
  if (observer_) {
    observer_->replanned(time, level(), replanning_.asked(), done);
  }
  if (step_ != Step::kPlaced) {
    // Not one frame shows a number, a depth or an alarm of the plan before.
    return guiding_.forget_guidance();
  }
  // Where the tool went stays; its wire is held against the plan in use.
  placing_.judge_again(level().plan.screws[guiding_.screw()]);
  tell_wire(time);
}

/// False where nothing waits for it.
bool Session::consents_to_breach(Timestamp time) {
  const auto screw = screw_to_replan();
  const auto* index = std::get_if<std::size_t>(&screw);
  if (!index) {
    return false;
  }
  const auto outcome = replanning_.consent(level(), *index, time, options_.message_for);
  if (outcome) {
    take_replan(*outcome, time);
  }
  return outcome.has_value();
}

void Session::consent(Timestamp time) {
  if (!consents_to_breach(time)) {
    messages_.say(NotPossibleNow{Event::kSayAccept}, time);
  }
}

}  // namespace orthonav::engine
