#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/side.h"
#include "base/translation.h"
#include "nav/tracking/tool.h"

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

/// What a step is about, as its name on display goes on to say: "guide L4 left".
enum class StepOf { kOperation, kLevel, kScrew, kRod };

struct StepFacts {
  /// In files and scripts, where it does not change with the display's language, and on display.
  const char* name;
  StepOf of;
  std::optional<nav::ToolRole> tool;  ///< the step's own; others may be used besides (`used_in`)
  const char* asks = "";              ///< the next act, where the step's state says no more
};
/// In the order of the steps.
inline constexpr auto kStepFacts = std::to_array<StepFacts>({
    {translatable("setup"), StepOf::kOperation, std::nullopt, translatable("say begin guiding")},
    {translatable("digitize"), StepOf::kLevel, nav::ToolRole::kPointer},
    {translatable("registering"), StepOf::kLevel, nav::ToolRole::kPointer, translatable("wait")},
    {translatable("verify"), StepOf::kLevel, nav::ToolRole::kPointer,
     translatable("say accept result or reject level")},
    {translatable("landmark"), StepOf::kLevel, nav::ToolRole::kPointer,
     translatable("say go to next")},
    {translatable("guide"), StepOf::kScrew, nav::ToolRole::kGuide},
    {translatable("measure"), StepOf::kScrew, nav::ToolRole::kGuide},
    {translatable("rod"), StepOf::kRod, nav::ToolRole::kPointer},
    {translatable("done"), StepOf::kOperation, std::nullopt},
});
inline constexpr std::size_t kStepCount = kStepFacts.size();
static_assert(kStepCount == static_cast<std::size_t>(Step::kDone) + 1);
[[nodiscard]] constexpr const StepFacts& facts_of(Step step) {
  return kStepFacts[static_cast<std::size_t>(step)];
}

/// A step, with its level and side.
struct StepOnDisplay {
  Step step = Step::kSetup;
  std::string level;         ///< "L4"; empty in steps without a level
  std::optional<Side> side;  ///< of the screw that is guided, or the rod

  friend auto operator<=>(const StepOnDisplay&, const StepOnDisplay&) = default;
};

// Names in files and scripts: "digitize"; "guide L4 left".
[[nodiscard]] constexpr std::string_view name_of(Step step) { return facts_of(step).name; }
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
