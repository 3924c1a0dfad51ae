#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/side.h"

namespace orthonav::engine {

/// The current step of the operation; the workflow's table decides every change
/// (engine/session/workflow/workflow.h).
enum class Step : std::uint8_t {
  kSetup,
  kDigitize,
  kRegistering,
  kVerify,
  kTouchLandmark,
  kGuide,
  kMeasureWire,
  kRod,
  kDone
};
inline constexpr std::size_t kStepCount = 9;

/// A step, with its level and side.
struct StepOnDisplay {
  Step step = Step::kSetup;
  std::string level;         ///< "L4"; empty in steps without a level
  std::optional<Side> side;  ///< of the screw that is guided, or the rod

  friend auto operator<=>(const StepOnDisplay&, const StepOnDisplay&) = default;
};

// Names in files and scripts, which do not change with the display's wording: "digitize"; "guide L4
// left".
[[nodiscard]] std::string_view name_of(Step step);
[[nodiscard]] std::string name_of(const StepOnDisplay& at);

/// The subject of the message on the status line; text/messages.h has its data, text/wording.h its
/// words.
enum class Notice : std::uint8_t {
  kNone,
  kNotPossibleNow,   ///< the input has no meaning in this step
  kNotUnderstood,    ///< a phrase
  kSaidTooEarly,     ///< "accept", before the result to be accepted was shown
  kNothingToDelete,  ///< no region, check point, touch of the landmark or head
  kConfirmDelete,    ///< another "delete" removes a saved region
  kRegistrationRefused,
  kChecksMissing,     ///< "accept", before the check points confirm it
  kTouchNotRecorded,  ///< of a check point, the landmark, a head or a rod
  kLandmarkMissing,   ///< "next", before the landmark was touched
  kLandmarkMoved,     ///< it is not where it was: the registration is verified again
  kBoneUnchecked,     ///< for too long: the landmark must be touched again
  kTipCorrected,      ///< of the guide, using the pointer's
  kAxisCorrected,     ///< of the guide, using a wire in its sleeve
  kWireUndecided,     ///< "next", while a wire beyond a limit awaits a decision
  kNoOtherEntry,      ///< through which the screw could be redone
  kConfirmRedo,       ///< another "delete" redoes a screw that was redone before
  kScrewRedone,       ///< with another entry
  kReplanRefused,     ///< a change of the screw was refused
  kReplanned,         ///< the screw was changed
  kNoRod,             ///< the heads do not allow one
  kMapMoved,          ///< the headset's map: measurements in it are lost
  kReferenceMoved,    ///< the patient reference: everything relative to it is lost
  kNoImages,          ///< the cameras deliver no images
  kEnded,
};

/// What the status line asks of a surgeon who verifies by touch, in any step.
enum class ChecksAsked : std::uint8_t {
  kNone,          ///< nothing about check points
  kTouchMore,     ///< more places, or the landmark before a screw
  kGuideTip,      ///< the guide's tip at the landmark too
  kGuideTipHeld,  ///< the same, held as for the next screw
  kCorrectGuide,  ///< consent to correct its tip or its axis
  kRecordWire,    ///< with the sleeve over it
  kDecideOnWire,  ///< beyond a limit: keep or redo
  kKeepWire,      ///< beyond a limit, and it can't be redone
  kReject,        ///< a check point lies too far off the surface
  kPassed,
};

/// The status line of one displayed frame.
struct ShownStatus {
  StepOnDisplay at;
  Notice notice = Notice::kNone;
  ChecksAsked checks = ChecksAsked::kNone;
  bool strokes_enough = false;  ///< the bar that fills while a level is stroked is full
  std::string text;             ///< as displayed
  std::string heard;            ///< the newest command heard, as displayed; empty: none
};

}  // namespace orthonav::engine
