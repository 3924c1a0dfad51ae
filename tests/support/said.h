#pragma once

#include <string>
#include <variant>

#include "engine/session/guidance.h"

namespace orthonav::test {

// The texts of a session, as data.

/// "guide L4 left", independent of the display.
inline std::string step_of(const engine::Guidance& guidance) {
  return engine::name_of(guidance.status.at);
}

inline engine::Notice notice_of(const engine::Guidance& guidance) {
  const engine::Message* message = guidance.status.message;
  return message ? engine::notice_of(*message) : engine::Notice::kNone;
}

/// The message if it is of that kind, or null.
template <class Kind>
const Kind* said(const engine::Guidance& guidance) {
  return guidance.status.message ? std::get_if<Kind>(guidance.status.message) : nullptr;
}

/// The state of the step if it is of that kind, or null.
template <class State>
const State* state(const engine::Guidance& guidance) {
  return std::get_if<State>(&guidance.status.state);
}

/// Why a touch was not recorded; fails the test by an exception if no refusal was shown.
inline engine::TouchRefusal touch_refusal(const engine::Guidance& guidance) {
  return std::get<engine::TouchNotRecorded>(*guidance.status.message).why;
}

/// The advice about check points that `verify` shows beside a registration.
inline nav::CheckAdvice advice(const engine::Guidance& guidance) {
  return std::get<engine::ChecksSoFar>(guidance.status.state).verdict->advice;
}

}  // namespace orthonav::test
