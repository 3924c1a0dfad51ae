#pragma once

#include <cstddef>
#include <cstdint>

namespace orthonav::engine {

/// Everything that can happen: what the surgeon does, and what the engine itself finds out.
enum class Event : std::uint8_t {
  kPress,
  kRelease,
  kClick,
  kDoubleClick,
  kHold,
  kSayStart,
  kSaySave,
  kSayDelete,
  kSayAccept,
  kSayReject,
  kSayNext,
  kSayDone,
  kSayMoveRod,
  kSayTwin,
  kSayDrill,
  kSayReplan,             ///< a change of the screw, with what it is to be: Replan
  kRegistered,            ///< a registration passed its limits
  kRegistrationRefused,   ///< a registration failed its limits
  kRegistrationRestored,  ///< one of an operation that was resumed, to be verified as any other
  kAcceptanceRestored,    ///< one that was accepted; its landmark can tell whether it still holds
  kChecked,               ///< "accept" was said and the check points bear it out
  kNotChecked,            ///< "accept" was said too early, or against the check points
  kLandmarkTouched,       ///< "next" was said and the landmark was found where it was recorded
  kLandmarkMissing,       ///< "next" was said before the landmark was touched
  kLandmarkMoved,         ///< the landmark was touched, farther from where it was than may be
  kBoneUnchecked,         ///< before a drill is set, World has walked too far since it was found
  kWireSettled,           ///< "next" was said, and nothing of the wire is left to decide
  kWireUndecided,         ///< "next" was said of a wire beyond a limit
  kScrewRedone,           ///< "delete" was said of it, and another entry was found
  kNoOtherEntry,          ///< and none was found
  kAnotherScrew,          ///< the level has a further screw
  kAnotherLevel,          ///< the level is finished, a further one is planned
  kNoScrewLeft,           ///< every screw of the plan is done
  kNoRodPlanned,          ///< and no side has two, which a rod would join
  kAnotherSide,           ///< the rod of the other side is still to do
  kNoSideLeft,            ///< both rods are done
  kTrackingLost,          ///< the step's tool is no longer measured
  kPoseStale,             ///< the step's tool was last measured longer ago than may be shown
  kTrackingRegained,      ///< the step's tool is measured again
  kMapMoved,              ///< the headset's map is another one: positions in it mean nothing now
  kReferenceHidden,       ///< no patient reference was seen for longer than guidance may stand
  kReferenceSeen,         ///< one is seen again, or for the first time
  kReferenceMoved,        ///< references moved against each other: what hangs on them means nothing
};
inline constexpr std::size_t kEventCount = 43;

/// What the session does about it. The first is the answer of a forgotten cell.
enum class Action : std::uint8_t {
  kRefuse,  ///< not possible now; the surgeon is told
  kIgnore,  ///< means nothing here, and need not be told
  kBeginLevel,
  kStartSampling,
  kStopSampling,
  kSaveRegion,
  kDropRegion,
  kRegister,
  kShowRegistration,
  kCountRefusal,
  kJudgeChecks,
  kAskForChecks,
  kRecordCheck,
  kDropCheck,
  kAccept,
  kClearLevel,
  kTouchLandmark,
  kDropLandmark,
  kJudgeLandmark,
  kAskForLandmark,
  kExpectLandmark,
  kVerifyAgain,
  kCorrectGuide,
  kSelectScrew,
  kExpectWire,
  kMeasureWire,
  kJudgeWire,
  kAskAboutWire,
  kKeepWire,
  kJudgeRedo,
  kOfferToKeep,
  kFinishScrew,
  kBeginRod,
  kBeginTouch,
  kEndTouch,
  kDropTouch,
  kRecordHead,
  kDropHead,
  kFinishRod,
  kMoveRod,
  kToggleTwin,
  kBeginDrill,
  kReplan,
  kConsent,
  kFinish,
  kWarnLost,
  kHideGuidance,
  kShowGuidance,
  kForgetMap,
};
inline constexpr std::size_t kActionCount = 49;

}  // namespace orthonav::engine
