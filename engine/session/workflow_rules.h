#pragma once

#include <array>

#include "engine/session/event.h"
#include "hal/api/shown_status.h"

namespace orthonav::engine {

using orthonav::Step;

/// One rule of the table.
struct Rule {
  Step step;
  Event event;
  Action action;
  Step next;
};

namespace workflow_detail {
using enum Step;
using enum Event;
using enum Action;

// clang-format off
inline constexpr auto kRules = std::to_array<Rule>({
    // When the map moves, what was measured in it is forgotten wherever anything was measured; a level
    // that is not finished is digitized again. With a patient reference the map does not matter; one
    // that moved does the same. While it is hidden nothing is shown on the patient, in any step.

    // Nothing is tracked for guidance before the operation starts. What a resumed operation
    // restored depends on references that may have moved meanwhile.
    {kSetup, kSayStart, kBeginLevel, kDigitize},
    {kSetup, kPress, kIgnore, kSetup},
    {kSetup, kRelease, kIgnore, kSetup},
    {kSetup, kClick, kIgnore, kSetup},
    {kSetup, kHold, kIgnore, kSetup},
    {kSetup, kTrackingLost, kIgnore, kSetup},
    {kSetup, kPoseStale, kIgnore, kSetup},
    {kSetup, kTrackingRegained, kIgnore, kSetup},
    {kSetup, kMapMoved, kIgnore, kSetup},
    {kSetup, kReferenceHidden, kIgnore, kSetup},
    {kSetup, kReferenceSeen, kIgnore, kSetup},
    {kSetup, kReferenceMoved, kForgetMap, kSetup},

    // Samples while the button is down; a double click asks for the registration. Its two clicks
    // come as clicks too and mean nothing of their own. A resumed operation goes on from here to
    // the step it had reached, with nothing verified.
    {kDigitize, kPress, kStartSampling, kDigitize},
    {kDigitize, kRelease, kStopSampling, kDigitize},
    {kDigitize, kClick, kIgnore, kDigitize},
    {kDigitize, kHold, kIgnore, kDigitize},
    {kDigitize, kSaySave, kSaveRegion, kDigitize},
    {kDigitize, kSayDelete, kDropRegion, kDigitize},
    {kDigitize, kDoubleClick, kRegister, kRegistering},
    {kDigitize, kRegistrationRestored, kShowRegistration, kVerify},
    {kDigitize, kAcceptanceRestored, kExpectLandmark, kAccepted},
    {kDigitize, kNoScrewLeft, kBeginRod, kRod},
    {kDigitize, kNoRodPlanned, kFinish, kDone},
    {kDigitize, kTrackingLost, kWarnLost, kDigitize},
    {kDigitize, kPoseStale, kHideGuidance, kDigitize},
    {kDigitize, kTrackingRegained, kShowGuidance, kDigitize},
    {kDigitize, kMapMoved, kForgetMap, kDigitize},
    {kDigitize, kReferenceHidden, kWarnLost, kDigitize},
    {kDigitize, kReferenceSeen, kIgnore, kDigitize},
    {kDigitize, kReferenceMoved, kForgetMap, kDigitize},

    // The registration is computed beside the session where time passes by itself. Nothing that the
    // surgeon says changes what it is computed from; a button has no meaning until it is answered.
    {kRegistering, kRegistered, kShowRegistration, kVerify},
    {kRegistering, kRegistrationRefused, kCountRefusal, kDigitize},
    {kRegistering, kPress, kIgnore, kRegistering},
    {kRegistering, kRelease, kIgnore, kRegistering},
    {kRegistering, kClick, kIgnore, kRegistering},
    {kRegistering, kHold, kIgnore, kRegistering},
    {kRegistering, kTrackingLost, kWarnLost, kRegistering},
    {kRegistering, kPoseStale, kHideGuidance, kRegistering},
    {kRegistering, kTrackingRegained, kShowGuidance, kRegistering},
    {kRegistering, kMapMoved, kForgetMap, kDigitize},
    {kRegistering, kReferenceHidden, kWarnLost, kRegistering},
    {kRegistering, kReferenceSeen, kIgnore, kRegistering},
    {kRegistering, kReferenceMoved, kForgetMap, kDigitize},

    // The surgeon looks at the hologram on the bone and touches places that were not stroked for it.
    // The only way on is their own word, and it counts once the touched places bear it out.
    {kVerify, kSayAccept, kJudgeChecks, kVerify},
    {kVerify, kChecked, kAccept, kAccepted},
    {kVerify, kNotChecked, kAskForChecks, kVerify},
    {kVerify, kSayReject, kClearLevel, kDigitize},
    {kVerify, kPress, kBeginTouch, kVerify},
    {kVerify, kRelease, kEndTouch, kVerify},
    {kVerify, kClick, kRecordCheck, kVerify},
    {kVerify, kDoubleClick, kIgnore, kVerify},
    {kVerify, kHold, kDropTouch, kVerify},
    {kVerify, kSayDelete, kDropCheck, kVerify},
    {kVerify, kTrackingLost, kWarnLost, kVerify},
    {kVerify, kPoseStale, kHideGuidance, kVerify},
    {kVerify, kTrackingRegained, kShowGuidance, kVerify},
    {kVerify, kMapMoved, kForgetMap, kDigitize},
    {kVerify, kReferenceHidden, kWarnLost, kVerify},
    {kVerify, kReferenceSeen, kIgnore, kVerify},
    {kVerify, kReferenceMoved, kForgetMap, kDigitize},

    // Before each screw the landmark is touched: recorded the first time, found again from then on.
    // One that is not where it was takes the acceptance back.
    {kAccepted, kSayNext, kJudgeLandmark, kAccepted},
    {kAccepted, kSayAccept, kCorrectGuide, kAccepted},
    {kAccepted, kLandmarkTouched, kSelectScrew, kGuide},
    {kAccepted, kLandmarkMissing, kAskForLandmark, kAccepted},
    {kAccepted, kLandmarkMoved, kVerifyAgain, kVerify},
    {kAccepted, kSayReplan, kReplan, kAccepted},
    {kAccepted, kSayReject, kClearLevel, kDigitize},
    {kAccepted, kPress, kBeginTouch, kAccepted},
    {kAccepted, kRelease, kEndTouch, kAccepted},
    {kAccepted, kClick, kTouchLandmark, kAccepted},
    {kAccepted, kDoubleClick, kIgnore, kAccepted},
    {kAccepted, kHold, kDropTouch, kAccepted},
    {kAccepted, kSayDelete, kDropLandmark, kAccepted},
    {kAccepted, kTrackingLost, kWarnLost, kAccepted},
    {kAccepted, kPoseStale, kHideGuidance, kAccepted},
    {kAccepted, kTrackingRegained, kShowGuidance, kAccepted},
    {kAccepted, kMapMoved, kForgetMap, kDigitize},
    {kAccepted, kReferenceHidden, kWarnLost, kAccepted},
    {kAccepted, kReferenceSeen, kIgnore, kAccepted},
    {kAccepted, kReferenceMoved, kForgetMap, kDigitize},

    // A registration that turns out wrong while guiding can be thrown away at any screw. The screw
    // is changed until its drill is set; one that would leave the cortex wants an "accept". Where the
    // map has drifted for long, the landmark is touched again before a drill is set.
    {kGuide, kSayNext, kExpectWire, kPlaced},
    {kGuide, kSayReject, kClearLevel, kDigitize},
    {kGuide, kSayTwin, kToggleTwin, kGuide},
    {kGuide, kSayNumbers, kToggleNumbers, kGuide},
    {kGuide, kBoneUnchecked, kExpectLandmark, kAccepted},
    {kGuide, kSayDrill, kBeginDrill, kGuide},
    {kGuide, kSayReplan, kReplan, kGuide},
    {kGuide, kSayAccept, kConsent, kGuide},
    {kGuide, kPress, kIgnore, kGuide},
    {kGuide, kRelease, kIgnore, kGuide},
    {kGuide, kClick, kToggleNumbers, kGuide},
    {kGuide, kHold, kIgnore, kGuide},
    {kGuide, kTrackingLost, kWarnLost, kGuide},
    {kGuide, kPoseStale, kHideGuidance, kGuide},
    {kGuide, kTrackingRegained, kShowGuidance, kGuide},
    {kGuide, kMapMoved, kForgetMap, kDigitize},
    {kGuide, kReferenceHidden, kWarnLost, kGuide},
    {kGuide, kReferenceSeen, kIgnore, kGuide},
    {kGuide, kReferenceMoved, kForgetMap, kDigitize},

    // The sleeve is set over the wire and clicked. A wire beyond a limit is kept by a word, redone
    // through another entry once the landmark was touched again, or the plan is changed to suit it.
    {kPlaced, kSayNext, kJudgeWire, kPlaced},
    {kPlaced, kSayAccept, kKeepWire, kPlaced},
    {kPlaced, kSayDelete, kJudgeRedo, kPlaced},
    {kPlaced, kSayReplan, kReplan, kPlaced},
    {kPlaced, kSayReject, kClearLevel, kDigitize},
    {kPlaced, kWireSettled, kFinishScrew, kPlaced},
    {kPlaced, kWireUndecided, kAskAboutWire, kPlaced},
    {kPlaced, kScrewRedone, kExpectLandmark, kAccepted},
    {kPlaced, kNoOtherEntry, kOfferToKeep, kPlaced},
    {kPlaced, kAnotherScrew, kExpectLandmark, kAccepted},
    {kPlaced, kAnotherLevel, kBeginLevel, kDigitize},
    {kPlaced, kNoScrewLeft, kBeginRod, kRod},
    {kPlaced, kNoRodPlanned, kFinish, kDone},
    {kPlaced, kPress, kBeginTouch, kPlaced},
    {kPlaced, kRelease, kEndTouch, kPlaced},
    {kPlaced, kClick, kMeasureWire, kPlaced},
    {kPlaced, kDoubleClick, kIgnore, kPlaced},
    {kPlaced, kHold, kDropTouch, kPlaced},
    {kPlaced, kTrackingLost, kWarnLost, kPlaced},
    {kPlaced, kPoseStale, kHideGuidance, kPlaced},
    {kPlaced, kTrackingRegained, kShowGuidance, kPlaced},
    {kPlaced, kMapMoved, kForgetMap, kDigitize},
    {kPlaced, kReferenceHidden, kWarnLost, kPlaced},
    {kPlaced, kReferenceSeen, kIgnore, kPlaced},
    {kPlaced, kReferenceMoved, kForgetMap, kDigitize},

    // Heads are touched with the pointer's tip; the tip is averaged while the button is down. A
    // button held too long makes no click, so its touch is dropped and the surgeon told.
    {kRod, kPress, kBeginTouch, kRod},
    {kRod, kRelease, kEndTouch, kRod},
    {kRod, kClick, kRecordHead, kRod},
    {kRod, kDoubleClick, kIgnore, kRod},
    {kRod, kHold, kDropTouch, kRod},
    {kRod, kSayDelete, kDropHead, kRod},
    {kRod, kSayDone, kFinishRod, kRod},
    {kRod, kSayMoveRod, kMoveRod, kRod},
    {kRod, kAnotherSide, kBeginRod, kRod},
    {kRod, kNoSideLeft, kFinish, kDone},
    {kRod, kTrackingLost, kWarnLost, kRod},
    {kRod, kPoseStale, kHideGuidance, kRod},
    {kRod, kTrackingRegained, kShowGuidance, kRod},
    {kRod, kMapMoved, kForgetMap, kRod},
    {kRod, kReferenceHidden, kWarnLost, kRod},
    {kRod, kReferenceSeen, kIgnore, kRod},
    {kRod, kReferenceMoved, kForgetMap, kRod},

    {kDone, kSayMoveRod, kMoveRod, kDone},
    {kDone, kPress, kIgnore, kDone},
    {kDone, kRelease, kIgnore, kDone},
    {kDone, kClick, kIgnore, kDone},
    {kDone, kHold, kIgnore, kDone},
    {kDone, kTrackingLost, kIgnore, kDone},
    {kDone, kPoseStale, kIgnore, kDone},
    {kDone, kTrackingRegained, kIgnore, kDone},
    {kDone, kMapMoved, kForgetMap, kDone},
    {kDone, kReferenceHidden, kIgnore, kDone},
    {kDone, kReferenceSeen, kIgnore, kDone},
    {kDone, kReferenceMoved, kForgetMap, kDone},
});

/// The answer that differs where rods alone are bent.
inline constexpr auto kRulesRodsAlone = std::to_array<Rule>({
    {kSetup, kSayStart, kBeginRod, kRod},
});

/// The answers that differ if verification is by eye alone.
inline constexpr auto kRulesByEye = std::to_array<Rule>({
    {kDigitize, kAcceptanceRestored, kRefuse, kDigitize},
    {kVerify, kSayAccept, kAccept, kAccepted},
    {kVerify, kChecked, kRefuse, kVerify},
    {kVerify, kNotChecked, kRefuse, kVerify},
    {kVerify, kPress, kIgnore, kVerify},
    {kVerify, kRelease, kIgnore, kVerify},
    {kVerify, kClick, kIgnore, kVerify},
    {kVerify, kDoubleClick, kRefuse, kVerify},
    {kVerify, kHold, kIgnore, kVerify},
    {kVerify, kSayDelete, kRefuse, kVerify},
    {kVerify, kTrackingLost, kIgnore, kVerify},
    {kVerify, kPoseStale, kIgnore, kVerify},
    {kVerify, kTrackingRegained, kIgnore, kVerify},
    {kAccepted, kSayNext, kSelectScrew, kGuide},
    {kAccepted, kSayAccept, kConsent, kAccepted},
    {kAccepted, kLandmarkTouched, kRefuse, kAccepted},
    {kAccepted, kLandmarkMissing, kRefuse, kAccepted},
    {kAccepted, kLandmarkMoved, kRefuse, kAccepted},
    {kAccepted, kPress, kIgnore, kAccepted},
    {kAccepted, kRelease, kIgnore, kAccepted},
    {kAccepted, kClick, kIgnore, kAccepted},
    {kAccepted, kDoubleClick, kRefuse, kAccepted},
    {kAccepted, kHold, kIgnore, kAccepted},
    {kAccepted, kSayDelete, kRefuse, kAccepted},
    {kAccepted, kTrackingLost, kIgnore, kAccepted},
    {kAccepted, kPoseStale, kIgnore, kAccepted},
    {kAccepted, kTrackingRegained, kIgnore, kAccepted},
    {kGuide, kSayNext, kFinishScrew, kGuide},
    {kGuide, kBoneUnchecked, kRefuse, kGuide},
    {kGuide, kAnotherScrew, kSelectScrew, kGuide},
    {kGuide, kAnotherLevel, kBeginLevel, kDigitize},
    {kGuide, kNoScrewLeft, kBeginRod, kRod},
    {kGuide, kNoRodPlanned, kFinish, kDone},
});

/// If the landmark is not touched again, the next screw follows at once.
inline constexpr auto kRulesTouchedOnce = std::to_array<Rule>({
    {kPlaced, kAnotherScrew, kSelectScrew, kGuide},
    {kPlaced, kScrewRedone, kSelectScrew, kGuide},
});

/// If the landmark is touched again but no wire is measured.
inline constexpr auto kRulesWireUnmeasured = std::to_array<Rule>({
    {kGuide, kAnotherScrew, kExpectLandmark, kAccepted},
    {kGuide, kBoneUnchecked, kExpectLandmark, kAccepted},
});
// clang-format on
}  // namespace workflow_detail

}  // namespace orthonav::engine
