#include "engine/session/text/messages.h"

#include <utility>

namespace orthonav::engine {

namespace {

struct ToNotice {
  Notice operator()(std::monostate /*none*/) const { return Notice::kNone; }
  Notice operator()(const NotPossibleNow& /*m*/) const { return Notice::kNotPossibleNow; }
  Notice operator()(const NotUnderstood& /*m*/) const { return Notice::kNotUnderstood; }
  Notice operator()(const SaidBeforeShown& /*m*/) const { return Notice::kSaidTooEarly; }
  Notice operator()(const NothingToDelete& /*m*/) const { return Notice::kNothingToDelete; }
  Notice operator()(const ConfirmDelete& /*m*/) const { return Notice::kConfirmDelete; }
  Notice operator()(const RegistrationRefused& /*m*/) const { return Notice::kRegistrationRefused; }
  Notice operator()(const ChecksMissing& /*m*/) const { return Notice::kChecksMissing; }
  Notice operator()(const TouchNotRecorded& /*m*/) const { return Notice::kTouchNotRecorded; }
  Notice operator()(const LandmarkMissing& /*m*/) const { return Notice::kLandmarkMissing; }
  Notice operator()(const LandmarkMoved& /*m*/) const { return Notice::kLandmarkMoved; }
  Notice operator()(const BoneUnchecked& /*m*/) const { return Notice::kBoneUnchecked; }
  Notice operator()(const TipCorrected& /*m*/) const { return Notice::kTipCorrected; }
  Notice operator()(const AxisCorrected& /*m*/) const { return Notice::kAxisCorrected; }
  Notice operator()(const WireUndecided& /*m*/) const { return Notice::kWireUndecided; }
  Notice operator()(const NoOtherEntry& /*m*/) const { return Notice::kNoOtherEntry; }
  Notice operator()(const ConfirmRedo& /*m*/) const { return Notice::kConfirmRedo; }
  Notice operator()(const ScrewRedone& /*m*/) const { return Notice::kScrewRedone; }
  Notice operator()(const ReplanUnclear& /*m*/) const { return Notice::kNotUnderstood; }
  Notice operator()(const ReplanRefusal& /*m*/) const { return Notice::kReplanRefused; }
  Notice operator()(const ScrewReplanned& /*m*/) const { return Notice::kReplanned; }
  Notice operator()(const NoRod& /*m*/) const { return Notice::kNoRod; }
  Notice operator()(const MapMoved& /*m*/) const { return Notice::kMapMoved; }
  Notice operator()(const ReferenceMoved& /*m*/) const { return Notice::kReferenceMoved; }
  Notice operator()(const NoImages& /*m*/) const { return Notice::kNoImages; }
  Notice operator()(const Ended& /*m*/) const { return Notice::kEnded; }
};

template <class... Kinds>
bool is_any(const Message& message) {
  return (std::holds_alternative<Kinds>(message) || ...);
}

}  // namespace

bool is_refusal(const Message& message) {
  // A new kind of message is a refusal until it stands here.
  return !is_any<std::monostate, LandmarkMoved, BoneUnchecked, TipCorrected, AxisCorrected,
                 ScrewRedone, ScrewReplanned, NoRod, MapMoved, ReferenceMoved, NoImages, Ended>(
      message);
}

Notice notice_of(const Message& message) { return std::visit(ToNotice{}, message); }

void Messages::say(Message message, Timestamp time) {
  message_ = std::move(message);
  message_until_ = time + message_for_;
  ++said_;
}

void Messages::echo(const Phrase& phrase, bool sure, const std::string& from) {
  heard_ = HeardCommand{phrase.text, sure, from};
  heard_until_ = phrase.time + heard_for_;
}

void Messages::expire(Timestamp now) {
  if (now >= message_until_) {
    clear();
  }
  if (now >= heard_until_) {
    heard_.reset();
  }
}

}  // namespace orthonav::engine
