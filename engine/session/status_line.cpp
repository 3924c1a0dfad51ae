#include "engine/session/status_line.h"

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

}  // namespace

ChecksAsked checks_asked(const StatusLine& line) {
  if (line.message) {
    const auto* missing = std::get_if<ChecksMissing>(line.message);
    return missing ? asked_by(missing->advice) : ChecksAsked::kNone;
  }
  const auto* checks = std::get_if<ChecksSoFar>(&line.state);
  return checks ? asked_by(checks->verdict->advice) : ChecksAsked::kNone;
}

}  // namespace orthonav::engine
