#pragma once

#include <string>
#include <variant>

#include "engine/session/guidance.h"

namespace orthonav::test {

// What a session says, as data.

/// "guide L4 left", whatever the display makes of it.
inline std::string step_of(const engine::Guidance& guidance) {
  return engine::name_of(guidance.status.at);
}

inline Notice notice_of(const engine::Guidance& guidance) {
  const engine::Message* message = guidance.status.message;
  return message ? engine::notice_of(*message) : Notice::kNone;
}

/// The message, where it is of that kind, or null.
template <class Kind>
const Kind* said(const engine::Guidance& guidance) {
  return guidance.status.message ? std::get_if<Kind>(guidance.status.message) : nullptr;
}

/// How the step stands, where it is told so, or null.
template <class State>
const State* state(const engine::Guidance& guidance) {
  return std::get_if<State>(&guidance.status.state);
}

/// Why a touch was not recorded; fails the test by an exception where that was not said.
inline engine::TouchRefusal touch_refusal(const engine::Guidance& guidance) {
  return std::get<engine::TouchNotRecorded>(*guidance.status.message).why;
}

/// What is still to be done about check points, as `verify` says it beside a registration.
inline nav::CheckAdvice advice(const engine::Guidance& guidance) {
  return std::get<engine::ChecksSoFar>(guidance.status.state).verdict->advice;
}

}  // namespace orthonav::test
