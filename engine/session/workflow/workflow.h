#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "base/translation.h"
#include "engine/session/shown_status.h"

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
  kLandmarkMoved,         ///< the landmark was touched too far from where it was
  kBoneUnchecked,     ///< before a drill is set: World has drifted too far since the bone was found
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
inline constexpr std::size_t kEventCount = 38;
/// In the same order. Spoken words are not translated.
inline constexpr std::array<std::string_view, kEventCount> kEventNames = {
    translatable("press"),
    translatable("release"),
    translatable("click"),
    translatable("double click"),
    translatable("hold"),
    "\"start\"",
    "\"save\"",
    "\"delete\"",
    "\"accept\"",
    "\"reject\"",
    "\"next\"",
    "\"done\"",
    "\"move rod\"",
    "\"twin\"",
    "\"numbers\"",
    "\"drill\"",
    translatable("change of the screw"),
    translatable("registered"),
    translatable("registration refused"),
    translatable("registration restored"),
    translatable("acceptance restored"),
    translatable("landmark moved"),
    translatable("bone unchecked"),
    translatable("screw redone"),
    translatable("no other entry"),
    translatable("another screw"),
    translatable("another level"),
    translatable("no screw left"),
    translatable("no rod planned"),
    translatable("another side"),
    translatable("no side left"),
    translatable("tracking lost"),
    translatable("pose stale"),
    translatable("tracking regained"),
    translatable("map moved"),
    translatable("reference hidden"),
    translatable("reference seen"),
    translatable("reference moved"),
};

/// What the session does about an event. The first is the default of cells without a rule.
enum class Action : std::uint8_t {
  kRefuse,  ///< not possible now; the surgeon is told
  kIgnore,  ///< nothing is to be done or said
  // The surgeon is told why nothing is done.
  kExplainNotShown,
  kExplainChecks,
  kExplainLandmark,
  kExplainWire,
  kExplainNoOtherEntry,
  kBeginLevel,
  kStartSampling,
  kStopSampling,
  kSaveRegion,
  kDropRegion,
  kRegister,
  kShowRegistration,
  kRecordCheck,
  kDropCheck,
  kAccept,
  kClearLevel,
  kRecordLandmark,
  kDropLandmark,
  kExpectLandmark,
  kVerifyAgain,
  kCorrectGuide,
  kSelectScrew,
  kExpectWire,
  kRecordWire,
  kKeepWire,
  kJudgeRedo,
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
  kTakeBreach,
  kHideGuidance,
  kShowGuidance,
  kForgetMap,
};
inline constexpr std::size_t kActionCount = static_cast<std::size_t>(Action::kForgetMap) + 1;
/// In the same order.
inline constexpr std::array<std::string_view, kActionCount> kActionNames = {
    "refuse",
    "ignore",
    "explain not shown",
    "explain checks",
    "explain landmark",
    "explain wire",
    "explain no other entry",
    "begin level",
    "start sampling",
    "stop sampling",
    "save region",
    "drop region",
    "register",
    "show registration",
    "record check point",
    "drop check point",
    "accept",
    "clear level",
    "record landmark",
    "drop landmark",
    "expect landmark",
    "verify again",
    "correct guide",
    "select screw",
    "expect wire",
    "record wire",
    "keep wire",
    "judge redo",
    "finish screw",
    "begin rod",
    "begin touch",
    "end touch",
    "drop touch",
    "record head",
    "drop head",
    "finish rod",
    "move rod",
    "show or hide twin",
    "show or hide numbers",
    "watch drill",
    "change screw",
    "take breach",
    "hide guidance",
    "show guidance",
    "forget map",
};

/// Whether it settles what was said last: a message to the surgeon stays until something else is
/// done, and so does a question.
[[nodiscard]] constexpr bool settles(Action action) {
  using enum Action;
  return action != kRefuse && action != kIgnore && action != kHideGuidance &&
         action != kShowGuidance && action != kForgetMap && action != kEndTouch;
}

/// What a session asks of the surgeon besides strokes and looks. Each can be left out on its own,
/// so that a study can measure its benefit (docs/decisions/0076-one-step-left-out.md); an operation
/// has all of them or, if verification is by eye alone, none.
struct MethodSteps {
  bool check_points = true;  ///< places of the bone touched in `verify` join the registration
  bool landmark = true;      ///< the landmark is touched again before each screw
  bool tips = true;          ///< the guide's tip is compared with the pointer's at the landmark
  bool wire = true;          ///< the placed wire is measured with the sleeve
  bool redo = true;          ///< a wire beyond a limit is redone through another entry
  bool axis = true;          ///< the guide's axis is corrected by its sleeve, turned on a wire

  /// Whether anything is touched in `landmark`.
  [[nodiscard]] constexpr bool touches_landmark() const { return landmark || tips; }
  [[nodiscard]] static constexpr MethodSteps none() {
    return {false, false, false, false, false, false};
  }
};

/// What the answer of a step may depend on besides the event; shown and recorded as the step. Where
/// several hold at once, the first one that has an answer gives it.
enum class State : std::uint8_t {
  kBreachPending,      ///< a change of the screw that leaves the cortex was shown and not taken yet
  kNotShown,           ///< the registration, to the surgeon
  kChecksPassed,       ///< the check points confirm the registration, or the eye alone verifies
  kCorrectionOffered,  ///< of the guide's tip or axis, once the landmark is touched
  kLandmarkTouched,    ///< since the last screw, and found where it was recorded
  kWireBeyondLimit,    ///< and neither kept nor redone yet
};
inline constexpr std::size_t kStateCount = 6;
/// In the same order.
inline constexpr std::array<std::string_view, kStateCount> kStateNames = {
    "breach pending",     "not shown",        "checks passed",
    "correction offered", "landmark touched", "wire beyond limit",
};
// A missing name at the end of an array would be empty.
static_assert(!kEventNames.back().empty() && !kActionNames.back().empty() &&
              !kStateNames.back().empty());

/// The answer of every step that has no rule of its own for the event.
struct UsualRule {
  Event event;
  Action action;
  std::optional<Step> next = {};  ///< absent: the step stays
};

/// One rule of the table.
struct Rule {
  Step step;
  Event event;
  Action action;
  Step next;
};

/// One that goes before the rule of its step while the state holds.
struct StateRule {
  Step step;
  State state;
  Event event;
  Action action;
  Step next;
};

namespace workflow_detail {
using enum Step;
using enum State;
using enum Event;
using enum Action;

// clang-format off
/// What most steps answer. The rules of a step, below, go before it.
inline constexpr auto kUsualRules = std::to_array<UsualRule>({
    // A button has no fixed meaning, so pressing it where it has none is no mistake.
    {kPress, kIgnore},
    {kRelease, kIgnore},
    {kClick, kIgnore},
    {kHold, kIgnore},

    // The status line shows which tool or reference is not seen.
    {kTrackingLost, kIgnore},
    {kPoseStale, kHideGuidance},
    {kTrackingRegained, kShowGuidance},
    {kReferenceHidden, kIgnore},
    {kReferenceSeen, kIgnore},

    // When the map moves, what was measured in it is forgotten wherever anything was measured; a level
    // that is not finished is digitized again. With a patient reference the map does not matter; one
    // that moved does the same. While it is hidden nothing is shown on the patient, in any step.
    {kMapMoved, kForgetMap, kDigitize},
    {kReferenceMoved, kForgetMap, kDigitize},
});

inline constexpr auto kRules = std::to_array<Rule>({
    // Nothing is tracked for guidance before the operation starts. What a resumed operation
    // restored depends on references that may have moved meanwhile.
    {kSetup, kSayStart, kBeginLevel, kDigitize},
    {kSetup, kPoseStale, kIgnore, kSetup},
    {kSetup, kTrackingRegained, kIgnore, kSetup},
    {kSetup, kMapMoved, kIgnore, kSetup},
    {kSetup, kReferenceMoved, kForgetMap, kSetup},

    // Samples while the button is down; a double click asks for the registration. Its two clicks
    // come as clicks too and mean nothing of their own. A resumed operation goes on from here to
    // the step it had reached, with nothing verified.
    {kDigitize, kPress, kStartSampling, kDigitize},
    {kDigitize, kRelease, kStopSampling, kDigitize},
    {kDigitize, kSaySave, kSaveRegion, kDigitize},
    {kDigitize, kSayDelete, kDropRegion, kDigitize},
    {kDigitize, kDoubleClick, kRegister, kRegistering},
    {kDigitize, kRegistrationRestored, kShowRegistration, kVerify},
    {kDigitize, kAcceptanceRestored, kExpectLandmark, kTouchLandmark},
    {kDigitize, kNoScrewLeft, kBeginRod, kRod},
    {kDigitize, kNoRodPlanned, kIgnore, kDone},

    // The registration is computed beside the session where time passes by itself. Nothing that the
    // surgeon says changes what it is computed from; a button has no meaning until it is answered.
    {kRegistering, kRegistered, kShowRegistration, kVerify},
    {kRegistering, kRegistrationRefused, kIgnore, kDigitize},

    // The surgeon looks at the hologram on the bone and touches places that were not stroked for it.
    // The only way on is their own word, and it counts once the touched places bear it out, unless
    // the eye alone verifies.
    {kVerify, kSayAccept, kExplainChecks, kVerify},
    {kVerify, kSayReject, kClearLevel, kDigitize},
    {kVerify, kPress, kBeginTouch, kVerify},
    {kVerify, kRelease, kEndTouch, kVerify},
    {kVerify, kClick, kRecordCheck, kVerify},
    {kVerify, kDoubleClick, kIgnore, kVerify},
    {kVerify, kHold, kDropTouch, kVerify},
    {kVerify, kSayDelete, kDropCheck, kVerify},

    // Before each screw the landmark is touched: recorded the first time, found again from then on.
    // One that is not where it was takes the acceptance back.
    {kTouchLandmark, kSayNext, kExplainLandmark, kTouchLandmark},
    {kTouchLandmark, kLandmarkMoved, kVerifyAgain, kVerify},
    {kTouchLandmark, kSayReplan, kReplan, kTouchLandmark},
    {kTouchLandmark, kSayReject, kClearLevel, kDigitize},
    {kTouchLandmark, kPress, kBeginTouch, kTouchLandmark},
    {kTouchLandmark, kRelease, kEndTouch, kTouchLandmark},
    {kTouchLandmark, kClick, kRecordLandmark, kTouchLandmark},
    {kTouchLandmark, kDoubleClick, kIgnore, kTouchLandmark},
    {kTouchLandmark, kHold, kDropTouch, kTouchLandmark},
    {kTouchLandmark, kSayDelete, kDropLandmark, kTouchLandmark},

    // A registration that turns out wrong while guiding can be thrown away at any screw. The screw
    // is changed until its drill is set; one that would leave the cortex wants an "accept". Where the
    // map has drifted for long, the landmark is touched again before a drill is set.
    {kGuide, kSayNext, kExpectWire, kMeasureWire},
    {kGuide, kSayReject, kClearLevel, kDigitize},
    {kGuide, kSayTwin, kToggleTwin, kGuide},
    {kGuide, kSayNumbers, kToggleNumbers, kGuide},
    {kGuide, kBoneUnchecked, kExpectLandmark, kTouchLandmark},
    {kGuide, kSayDrill, kBeginDrill, kGuide},
    {kGuide, kSayReplan, kReplan, kGuide},
    {kGuide, kClick, kToggleNumbers, kGuide},

    // The sleeve is set over the wire and clicked. A wire beyond a limit is kept by a word, redone
    // through another entry once the landmark was touched again, or the plan is changed to suit it.
    {kMeasureWire, kSayNext, kFinishScrew, kMeasureWire},
    {kMeasureWire, kSayDelete, kJudgeRedo, kMeasureWire},
    {kMeasureWire, kSayReplan, kReplan, kMeasureWire},
    {kMeasureWire, kSayReject, kClearLevel, kDigitize},
    {kMeasureWire, kScrewRedone, kExpectLandmark, kTouchLandmark},
    {kMeasureWire, kNoOtherEntry, kExplainNoOtherEntry, kMeasureWire},
    {kMeasureWire, kAnotherScrew, kExpectLandmark, kTouchLandmark},
    {kMeasureWire, kAnotherLevel, kBeginLevel, kDigitize},
    {kMeasureWire, kNoScrewLeft, kBeginRod, kRod},
    {kMeasureWire, kNoRodPlanned, kIgnore, kDone},
    {kMeasureWire, kPress, kBeginTouch, kMeasureWire},
    {kMeasureWire, kRelease, kEndTouch, kMeasureWire},
    {kMeasureWire, kClick, kRecordWire, kMeasureWire},
    {kMeasureWire, kDoubleClick, kIgnore, kMeasureWire},
    {kMeasureWire, kHold, kDropTouch, kMeasureWire},

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
    {kRod, kSayNumbers, kToggleNumbers, kRod},
    {kRod, kAnotherSide, kBeginRod, kRod},
    {kRod, kNoSideLeft, kIgnore, kDone},
    {kRod, kMapMoved, kForgetMap, kRod},
    {kRod, kReferenceMoved, kForgetMap, kRod},

    {kDone, kSayMoveRod, kMoveRod, kDone},
    {kDone, kPoseStale, kIgnore, kDone},
    {kDone, kTrackingRegained, kIgnore, kDone},
    {kDone, kMapMoved, kForgetMap, kDone},
    {kDone, kReferenceMoved, kForgetMap, kDone},
});

/// "accept" and "next" mean what was asked last: a breach first, since its question is the newest.
inline constexpr auto kStateRules = std::to_array<StateRule>({
    {kVerify, kNotShown, kSayAccept, kExplainNotShown, kVerify},
    {kVerify, kChecksPassed, kSayAccept, kAccept, kTouchLandmark},

    {kTouchLandmark, kBreachPending, kSayAccept, kTakeBreach, kTouchLandmark},
    {kTouchLandmark, kCorrectionOffered, kSayAccept, kCorrectGuide, kTouchLandmark},
    {kTouchLandmark, kLandmarkTouched, kSayNext, kSelectScrew, kGuide},

    {kGuide, kBreachPending, kSayAccept, kTakeBreach, kGuide},

    {kMeasureWire, kBreachPending, kSayAccept, kTakeBreach, kMeasureWire},
    {kMeasureWire, kWireBeyondLimit, kSayAccept, kKeepWire, kMeasureWire},
    {kMeasureWire, kWireBeyondLimit, kSayNext, kExplainWire, kMeasureWire},
});

/// The answer that differs where rods alone are bent.
inline constexpr auto kRulesRodsAlone = std::to_array<Rule>({
    {kSetup, kSayStart, kBeginRod, kRod},
});

/// The answers that differ if verification is by eye alone.
inline constexpr auto kRulesByEye = std::to_array<Rule>({
    {kDigitize, kAcceptanceRestored, kRefuse, kDigitize},
    {kVerify, kPress, kIgnore, kVerify},
    {kVerify, kRelease, kIgnore, kVerify},
    {kVerify, kClick, kIgnore, kVerify},
    {kVerify, kDoubleClick, kRefuse, kVerify},
    {kVerify, kHold, kIgnore, kVerify},
    {kVerify, kSayDelete, kRefuse, kVerify},
    {kVerify, kPoseStale, kIgnore, kVerify},
    {kVerify, kTrackingRegained, kIgnore, kVerify},
    {kTouchLandmark, kSayNext, kSelectScrew, kGuide},
    {kTouchLandmark, kLandmarkMoved, kRefuse, kTouchLandmark},
    {kTouchLandmark, kPress, kIgnore, kTouchLandmark},
    {kTouchLandmark, kRelease, kIgnore, kTouchLandmark},
    {kTouchLandmark, kClick, kIgnore, kTouchLandmark},
    {kTouchLandmark, kDoubleClick, kRefuse, kTouchLandmark},
    {kTouchLandmark, kHold, kIgnore, kTouchLandmark},
    {kTouchLandmark, kSayDelete, kRefuse, kTouchLandmark},
    {kTouchLandmark, kPoseStale, kIgnore, kTouchLandmark},
    {kTouchLandmark, kTrackingRegained, kIgnore, kTouchLandmark},
    {kGuide, kSayNext, kFinishScrew, kGuide},
    {kGuide, kBoneUnchecked, kRefuse, kGuide},
    {kGuide, kAnotherScrew, kSelectScrew, kGuide},
    {kGuide, kAnotherLevel, kBeginLevel, kDigitize},
    {kGuide, kNoScrewLeft, kBeginRod, kRod},
    {kGuide, kNoRodPlanned, kIgnore, kDone},
});

/// If the landmark is not touched again, the next screw follows at once.
inline constexpr auto kRulesTouchedOnce = std::to_array<Rule>({
    {kMeasureWire, kAnotherScrew, kSelectScrew, kGuide},
    {kMeasureWire, kScrewRedone, kSelectScrew, kGuide},
});

/// If the landmark is touched again but no wire is measured.
inline constexpr auto kRulesWireUnmeasured = std::to_array<Rule>({
    {kGuide, kAnotherScrew, kExpectLandmark, kTouchLandmark},
    {kGuide, kBoneUnchecked, kExpectLandmark, kTouchLandmark},
});
// clang-format on
}  // namespace workflow_detail

struct Cell {
  Step next = Step::kSetup;
  Action action = Action::kRefuse;
  friend constexpr bool operator==(const Cell&, const Cell&) = default;
};

namespace workflow_detail {
using enum Step;
using enum Action;

using Table = std::array<std::array<Cell, kEventCount>, kStepCount>;

/// Whether this step is done by eye alone, without touching.
constexpr bool is_by_eye(Step step, const MethodSteps& steps) {
  return (step == kDigitize && !steps.landmark) || (step == kVerify && !steps.check_points) ||
         (step == kTouchLandmark && !steps.touches_landmark()) || (step == kGuide && !steps.wire);
}

/// Every cell starts as a refusal that stays in its step; the usual answers and then the rules
/// overwrite theirs.
constexpr Table make_table(const MethodSteps& steps, bool rods_alone) {
  Table table{};
  for (std::size_t step = 0; step < kStepCount; ++step) {
    for (Cell& cell : table[step]) {
      cell = {static_cast<Step>(step), kRefuse};
    }
    for (const UsualRule& rule : kUsualRules) {
      table[step][static_cast<std::size_t>(rule.event)] = {
          rule.next.value_or(static_cast<Step>(step)), rule.action};
    }
  }
  const auto write = [&table](const Rule& rule) {
    table[static_cast<std::size_t>(rule.step)][static_cast<std::size_t>(rule.event)] = {
        rule.next, rule.action};
  };
  std::for_each(kRules.begin(), kRules.end(), write);
  for (const Rule& rule : kRulesByEye) {
    if (is_by_eye(rule.step, steps)) {
      write(rule);
    }
  }
  if (!steps.landmark && steps.wire) {
    std::for_each(kRulesTouchedOnce.begin(), kRulesTouchedOnce.end(), write);
  } else if (steps.landmark && !steps.wire) {
    std::for_each(kRulesWireUnmeasured.begin(), kRulesWireUnmeasured.end(), write);
  }
  if (rods_alone) {
    std::for_each(kRulesRodsAlone.begin(), kRulesRodsAlone.end(), write);
  }
  return table;
}

/// Two rules for one cell would silently hide the first.
consteval bool rules_are_unique(const auto& rules) {
  for (std::size_t i = 0; i < rules.size(); ++i) {
    for (std::size_t j = i + 1; j < rules.size(); ++j) {
      if (rules[i].step == rules[j].step && rules[i].event == rules[j].event) {
        return false;
      }
    }
  }
  return true;
}
static_assert(rules_are_unique(kRules) && rules_are_unique(kRulesByEye) &&
                  rules_are_unique(kRulesTouchedOnce) && rules_are_unique(kRulesWireUnmeasured) &&
                  rules_are_unique(kRulesRodsAlone),
              "two rules of the workflow share a cell");

/// Of one step and event, the rules are in the order of `State`: the first that holds answers.
consteval bool state_rules_are_in_order() {
  for (std::size_t i = 0; i < kStateRules.size(); ++i) {
    for (std::size_t j = i + 1; j < kStateRules.size(); ++j) {
      const StateRule& a = kStateRules[i];
      const StateRule& b = kStateRules[j];
      if (a.step == b.step && a.event == b.event && a.state >= b.state) {
        return false;
      }
    }
  }
  return true;
}
static_assert(state_rules_are_in_order(), "a rule of the workflow hides another one");
}  // namespace workflow_detail

/// How a registration whose numbers passed is verified before anything is guided on it.
enum class Verification : std::uint8_t {
  kByTouch,  ///< by eye and by touching places of the bone
  kByEye,    ///< by eye alone, as in the published method
};

using Workflow = workflow_detail::Table;

/// The table with only these steps of the method; with `rods_alone` it goes from setup to the rods.
[[nodiscard]] constexpr Workflow workflow_of(const MethodSteps& steps, bool rods_alone = false) {
  return workflow_detail::make_table(steps, rods_alone);
}
inline constexpr Workflow kWorkflow = workflow_of(MethodSteps{});
inline constexpr Workflow kWorkflowRodsAlone = workflow_of(MethodSteps{}, true);
inline constexpr Workflow kWorkflowByEye = workflow_of(MethodSteps::none());

/// A table's answer while none of the states holds: every step answers every event.
[[nodiscard]] constexpr Cell answer(const Workflow& table, Step step, Event event) {
  return table[static_cast<std::size_t>(step)][static_cast<std::size_t>(event)];
}
/// A table's answer; `holds(State)` says which states do.
[[nodiscard]] constexpr Cell answer(const Workflow& table, Step step, Event event,
                                    const auto& holds) {
  for (const StateRule& rule : workflow_detail::kStateRules) {
    if (rule.step == step && rule.event == event && holds(rule.state)) {
      return {rule.next, rule.action};
    }
  }
  return answer(table, step, event);
}
[[nodiscard]] constexpr Cell answer(Step step, Event event,
                                    Verification verification = Verification::kByTouch) {
  return answer(verification == Verification::kByEye ? kWorkflowByEye : kWorkflow, step, event);
}

[[nodiscard]] constexpr std::string_view name_of(State state) {
  return kStateNames[static_cast<std::size_t>(state)];
}
[[nodiscard]] constexpr std::string_view name_of(Event event) {
  return kEventNames[static_cast<std::size_t>(event)];
}
[[nodiscard]] constexpr std::string_view name_of(Action action) {
  return kActionNames[static_cast<std::size_t>(action)];
}

}  // namespace orthonav::engine
