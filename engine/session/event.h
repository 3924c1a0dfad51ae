#pragma once

#include <cstddef>
#include <cstdint>

namespace orthonav::engine {

/// Everything that can happen: what the surgeon does, and what the engine detects.
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
  kSayNumbers,
  kSayDrill,
  kSayReplan,             ///< a change of the screw; Replan says which
  kRegistered,            ///< a registration passed its limits
  kRegistrationRefused,   ///< a registration failed its limits
  kRegistrationRestored,  ///< a registration of a resumed operation, to be verified like any other
  kAcceptanceRestored,    ///< an accepted one; its landmark can show whether it still holds
  kChecked,               ///< "accept" was said and the check points confirm the registration
  kNotChecked,            ///< "accept" was said too early, or against the check points
  kLandmarkTouched,       ///< "next" was said and the landmark was found where it was recorded
  kLandmarkMissing,       ///< "next" was said before the landmark was touched
  kLandmarkMoved,         ///< the landmark was touched too far from where it was
  kBoneUnchecked,     ///< before a drill is set: World has drifted too far since the bone was found
  kWireSettled,       ///< "next" was said, and nothing of the wire is left to decide
  kWireUndecided,     ///< "next" was said of a wire beyond a limit
  kScrewRedone,       ///< "delete" was said of a wire, and another entry was found
  kNoOtherEntry,      ///< "delete" was said of a wire, and no other entry was found
  kAnotherScrew,      ///< the level has a further screw
  kAnotherLevel,      ///< the level is finished, a further one is planned
  kNoScrewLeft,       ///< every screw of the plan is done
  kNoRodPlanned,      ///< every screw is done, and no side has two for a rod to join
  kAnotherSide,       ///< the rod of the other side is still to do
  kNoSideLeft,        ///< both rods are done
  kTrackingLost,      ///< the step's tool is no longer measured
  kPoseStale,         ///< the step's tool was last measured too long ago to be shown
  kTrackingRegained,  ///< the step's tool is measured again
  kMapMoved,          ///< the headset's map was replaced: old positions are meaningless
  kReferenceHidden,   ///< no patient reference was seen for longer than guidance may stay
  kReferenceSeen,     ///< a reference is seen again, or for the first time
  kReferenceMoved,    ///< references moved against each other: positions relative to them are void
};
inline constexpr std::size_t kEventCount = 44;

/// What the session does about an event. The first is the default of cells without a rule.
enum class Action : std::uint8_t {
  kRefuse,  ///< not possible now; the surgeon is told
  kIgnore,  ///< has no meaning here; the surgeon is not told
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
  kToggleNumbers,
  kBeginDrill,
  kReplan,
  kConsent,
  kFinish,
  kWarnLost,
  kHideGuidance,
  kShowGuidance,
  kForgetMap,
};
inline constexpr std::size_t kActionCount = static_cast<std::size_t>(Action::kForgetMap) + 1;

}  // namespace orthonav::engine
