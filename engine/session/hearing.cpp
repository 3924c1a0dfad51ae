#include "engine/session/hearing.h"

#include "engine/session/spoken_commands.h"
#include "engine/session/spoken_replan.h"

namespace orthonav::engine {
namespace {

bool understood(const OperationInWork& work, const Phrase& phrase) {
  return phrase.confidence >= work.options.min_voice_confidence;
}

std::optional<Event> hear_replan(OperationInWork& work, SessionSteps& steps, const Phrase& phrase,
                                 const Result<Replan>& replan, const std::string& from) {
  const bool sure = understood(work, phrase);
  work.messages.echo(phrase, sure, from);
  if (sure && replan) {
    steps.replanning.ask(*replan);
    return Event::kSayReplan;
  }
  work.messages.say(sure ? Message(ReplanUnclear{replan.error()}) : Message(NotUnderstood{}),
                    phrase.time);
  work.observer->not_understood(phrase);
  return std::nullopt;
}

}  // namespace

std::optional<Event> hear(OperationInWork& work, SessionSteps& steps, const Phrase& phrase,
                          const std::string& from) {
  const auto event = command_event(phrase.text);
  if (const auto replan = event ? std::nullopt : replan_from(phrase.text)) {
    return hear_replan(work, steps, phrase, *replan, from);
  }
  const bool sure = understood(work, phrase);
  if (event) {
    work.messages.echo(phrase, sure, from);
  }
  if (!sure) {
    work.messages.say(NotUnderstood{}, phrase.time);
  }
  if (!event || !sure) {
    work.observer->not_understood(phrase);
    return std::nullopt;
  }
  if (work.step == Step::kVerify && *event == Event::kSayAccept &&
      !steps.verifying.shown_before(phrase.time)) {
    work.observer->happened(phrase.time, work.step, *event, Cell{work.step, Action::kRefuse});
    work.messages.say(SaidBeforeShown{}, phrase.time);
    return std::nullopt;
  }
  return event;
}

std::optional<Event> hear(OperationInWork& work, SessionSteps& steps, const Request& request) {
  work.observer->asked_from_outside(request);
  const Phrase phrase{request.text, 1.0, request.time};
  return request.change ? hear_replan(work, steps, phrase, *request.change, request.from)
                        : hear(work, steps, phrase, request.from);
}

}  // namespace orthonav::engine
