#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/side.h"

namespace orthonav {

/// Where the operation stands. One step at a time; the workflow's table decides every change
/// (engine/session/workflow.h).
enum class Step : std::uint8_t {
  kSetup,
  kDigitize,
  kVerify,
  kAccepted,
  kGuide,
  kPlaced,
  kRod,
  kDone
};
inline constexpr std::size_t kStepCount = 8;

/// A step and what it is about.
struct StepOnDisplay {
  Step step = Step::kSetup;
  std::string level;         ///< "L4"; empty in steps of no level
  std::optional<Side> side;  ///< of the screw that is guided, or the rod

  friend auto operator<=>(const StepOnDisplay&, const StepOnDisplay&) = default;
};

// Names in files and scripts, which stay whatever the display says: "digitize"; "guide L4 left".
[[nodiscard]] std::string_view name_of(Step step);
[[nodiscard]] std::string name_of(const StepOnDisplay& at);

/// What the message on the status line is about. Its data and its words are the engine's.
enum class Notice : std::uint8_t {
  kNone,
  kNotPossibleNow,   ///< what was done means nothing in this step
  kNotUnderstood,    ///< a phrase
  kSaidTooEarly,     ///< "accept", before what is to be accepted was shown
  kNothingToDelete,  ///< no region, check point, touch of the landmark or head
  kConfirmDelete,    ///< a saved region goes when "delete" is said again
  kRegistrationRefused,
  kChecksMissing,     ///< "accept", while the check points do not bear it out
  kTouchNotRecorded,  ///< of a check point, the landmark or a head
  kLandmarkMissing,   ///< "next", before the landmark was touched
  kLandmarkMoved,     ///< it is not where it was: the registration is verified again
  kBoneUnchecked,     ///< for long: the landmark is to be touched again
  kTipCorrected,      ///< of the guide, by the pointer's
  kAxisCorrected,     ///< of the guide, by a wire in its sleeve
  kWireUndecided,     ///< "next", while a wire beyond a limit waits for a word
  kNoOtherEntry,      ///< through which its screw could be redone
  kConfirmRedo,       ///< a screw that was redone is so again when "delete" is said again
  kScrewRedone,       ///< it has another entry
  kReplanRefused,     ///< a change of the screw
  kReplanned,         ///< the screw was changed
  kNoRod,             ///< the heads give none
  kMapMoved,          ///< the headset's map: what was measured in it is gone
  kReferenceMoved,    ///< the patient's: what hung on it is gone
  kNoImages,          ///< the cameras deliver none
  kEnded,
};

/// What the status line asks of a surgeon who verifies by touch, in whatever step.
enum class ChecksAsked : std::uint8_t {
  kNone,          ///< it says nothing of check points
  kTouchMore,     ///< further places, or the landmark before a screw
  kGuideTip,      ///< the guide's tip in the landmark too
  kCorrectGuide,  ///< consent to correct its tip or its axis
  kMeasureWire,   ///< by the sleeve over it
  kDecideOnWire,  ///< beyond a limit: to keep it or to redo it
  kKeepWire,      ///< beyond a limit, and it can't be redone
  kReject,        ///< a check point lies too far off the surface
  kPassed,
};

/// The status line of one displayed frame.
struct ShownStatus {
  StepOnDisplay at;
  Notice notice = Notice::kNone;
  ChecksAsked checks = ChecksAsked::kNone;
  std::string text;   ///< as it is written
  std::string heard;  ///< the newest command that was heard, as it is written; empty: none
};

}  // namespace orthonav
