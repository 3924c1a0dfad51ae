#include "engine/session/session.h"
#include "engine/session/spoken_commands.h"
#include "engine/session/spoken_replan.h"

namespace orthonav::engine {

void Session::hear(const Phrase& phrase, const std::string& from) {
  const auto event = command_event(phrase.text);
  if (const auto replan = event ? std::nullopt : replan_from(phrase.text)) {
    return hear_replan(phrase, *replan, from);
  }
  const bool sure = phrase.confidence >= options_.min_voice_confidence;
  if (event) {
    messages_.echo(phrase, sure, from);
  }
  if (!event || !sure) {
    if (!sure) {
      messages_.say(NotUnderstood{}, phrase.time);
    }
    if (observer_) {
      observer_->not_understood(phrase);
    }
  } else if (step_ == Step::kVerify && *event == Event::kSayAccept &&
             !verifying_.shown_before(phrase.time)) {
    if (observer_) {
      observer_->happened(phrase.time, step_, *event, Cell{step_, Action::kRefuse});
    }
    messages_.say(SaidBeforeShown{}, phrase.time);
  } else {
    handle(*event, phrase.time);
  }
}

/// Another program is sure of what it asks.
void Session::hear(const Request& request) {
  if (observer_) {
    observer_->asked_from_outside(request);
  }
  const Phrase phrase{request.text, 1.0, request.time};
  if (request.change) {
    return hear_replan(phrase, *request.change, request.from);
  }
  hear(phrase, request.from);
}

void Session::hear_replan(const Phrase& phrase, const Result<Replan>& replan,
                          const std::string& from) {
  const bool sure = phrase.confidence >= options_.min_voice_confidence;
  messages_.echo(phrase, sure, from);
  if (sure && replan) {
    replanning_.ask(*replan);
    return handle(Event::kSayReplan, phrase.time);
  }
  messages_.say(sure ? Message(ReplanUnclear{replan.error()}) : Message(NotUnderstood{}),
                phrase.time);
  if (observer_) {
    observer_->not_understood(phrase);
  }
}

}  // namespace orthonav::engine
