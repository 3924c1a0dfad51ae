#include "engine/session/text/status_line.h"

namespace orthonav::engine {

namespace {

ChecksAsked asked_by(const nav::CheckAdvice& advice) {
  switch (advice.kind) {
    case nav::CheckAdvice::Kind::kNone:
      return ChecksAsked::kPassed;
    case nav::CheckAdvice::Kind::kTouchApart:
    case nav::CheckAdvice::Kind::kTouchOffLine:
    case nav::CheckAdvice::Kind::kTouchMore:
      return ChecksAsked::kTouchMore;
    case nav::CheckAdvice::Kind::kReject:
    case nav::CheckAdvice::Kind::kUncertain:
      return ChecksAsked::kReject;
  }
  return ChecksAsked::kNone;
}

ChecksAsked asked_in(const Message& message) {
  if (std::holds_alternative<LandmarkMissing>(message) ||
      std::holds_alternative<LandmarkMoved>(message) ||
      std::holds_alternative<BoneUnchecked>(message) ||
      std::holds_alternative<ScrewRedone>(message)) {
    return ChecksAsked::kTouchMore;
  }
  if (std::holds_alternative<WireUndecided>(message) ||
      std::holds_alternative<ConfirmRedo>(message)) {
    return ChecksAsked::kDecideOnWire;
  }
  if (std::holds_alternative<NoOtherEntry>(message)) {
    return ChecksAsked::kKeepWire;
  }
  const auto* missing = std::get_if<ChecksMissing>(&message);
  return missing ? asked_by(missing->advice) : ChecksAsked::kNone;
}

ChecksAsked asked_about(const WireSoFar& state) {
  if (state.wire == nullptr) {
    return ChecksAsked::kRecordWire;
  }
  if (!state.wire->undecided()) {
    return ChecksAsked::kPassed;
  }
  return state.no_other_entry ? ChecksAsked::kKeepWire : ChecksAsked::kDecideOnWire;
}

}  // namespace

ChecksAsked checks_asked(const StatusLine& line) {
  if (line.message && !is_about_replan(*line.message)) {
    return asked_in(*line.message);
  }
  if (const auto* wire = std::get_if<WireSoFar>(&line.state)) {
    return asked_about(*wire);
  }
  if (const auto* landmark = std::get_if<LandmarkSoFar>(&line.state)) {
    if (!landmark->last || landmark->last->missing > 0) {
      return ChecksAsked::kTouchMore;
    }
    if (landmark->tips == nullptr) {
      return ChecksAsked::kPassed;
    }
    if (landmark->tips->due()) {
      return landmark->tips->for_screw() ? ChecksAsked::kGuideTipHeld : ChecksAsked::kGuideTip;
    }
    const bool axis = landmark->axis != nullptr && landmark->axis->offers();
    return landmark->tips->offers() || axis ? ChecksAsked::kCorrectGuide : ChecksAsked::kPassed;
  }
  const auto* checks = std::get_if<ChecksSoFar>(&line.state);
  return checks ? asked_by(checks->verdict->advice) : ChecksAsked::kNone;
}

}  // namespace orthonav::engine
