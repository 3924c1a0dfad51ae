#include "engine/session/workflow/workflow.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace orthonav::engine::workflow_test {
namespace {

constexpr const char* kBegin = "<!-- workflow begin -->\n";
constexpr const char* kEnd = "<!-- workflow end -->";

std::string written_workflow() {
  std::ifstream in(std::string(ORTHONAV_SOURCE_DIR) + "/docs/safety.md");
  std::stringstream text;
  text << in.rdbuf();
  const std::string all = text.str();
  const std::size_t begin = all.find(kBegin);
  const std::size_t end = all.find(kEnd);
  if (begin == std::string::npos || end == std::string::npos) {
    return {};
  }
  const std::size_t from = begin + std::string(kBegin).size();
  return all.substr(from, end - from);
}

/// The step that an answer leads to; none if it stays.
using Leads = std::optional<Step>;
/// What is answered, and by which action: events with the same answer are listed together.
using Answers = std::vector<std::pair<std::string, std::vector<std::string_view>>>;

std::string text_of(Action action, Leads leads) {
  std::string text(name_of(action));
  return leads ? text + " → **" + std::string(name_of(*leads)) + "**" : text;
}

void add(Answers& answers, Event event, const std::string& answer) {
  const auto same = std::ranges::find(answers, answer, &Answers::value_type::first);
  if (same == answers.end()) {
    answers.push_back({answer, {name_of(event)}});
  } else {
    same->second.push_back(name_of(event));
  }
}

/// A list item in lines of at most 120 characters.
std::string item(const std::string& heading, const Answers& answers) {
  std::string text = "- **" + heading + "**";
  const char* separator = " ";
  for (const auto& [answer, events] : answers) {
    for (const std::string_view event : events) {
      text += separator + std::string(event);
      separator = ", ";
    }
    text += ": " + answer;
    separator = "; ";
  }
  std::stringstream words(text + ".");
  std::string out;
  std::size_t column = 0;
  for (std::string word; words >> word;) {
    const bool first = out.empty();
    // An arrow is three bytes and one character.
    const std::size_t width = word == "→" ? 1 : word.size();
    const bool fits = column + 1 + width <= 120;
    out += first ? word : (fits ? " " : "\n  ") + word;
    column = (first ? 0 : fits ? column + 1 : 2) + width;
  }
  return out + "\n";
}

/// The answer of most steps to an event; the safer one if two are as frequent.
std::pair<Action, Leads> usual_answer(Event event) {
  std::map<std::pair<Action, Leads>, int> count;
  for (std::size_t s = 0; s < kStepCount; ++s) {
    const auto step = static_cast<Step>(s);
    const Cell cell = answer(step, event);
    ++count[{cell.action, cell.next == step ? Leads() : Leads(cell.next)}];
  }
  // `kRefuse` and `kIgnore` come first in `Action`.
  return std::ranges::max_element(count, {}, [](const auto& entry) { return entry.second; })->first;
}

std::string usual_answers() {
  Answers answers;
  for (std::size_t e = 0; e < kEventCount; ++e) {
    const auto event = static_cast<Event>(e);
    const auto [action, leads] = usual_answer(event);
    if (action != Action::kRefuse) {
      add(answers, event, text_of(action, leads));
    }
  }
  answers.push_back({"refuse", {"everything else"}});
  return item("by default", answers);
}

/// What a step answers otherwise than most do.
std::string answers_of(Step step) {
  Answers answers;
  for (std::size_t e = 0; e < kEventCount; ++e) {
    const auto event = static_cast<Event>(e);
    const Cell cell = answer(step, event);
    const auto [action, leads] = usual_answer(event);
    if (cell != Cell{leads.value_or(step), action}) {
      add(answers, event, text_of(cell.action, cell.next == step ? Leads() : Leads(cell.next)));
    }
  }
  return item(std::string(name_of(step)), answers);
}

/// What it answers otherwise in each of its states.
std::string answers_in_states_of(Step step) {
  std::string out;
  for (std::size_t s = 0; s < kStateCount; ++s) {
    const auto state = static_cast<State>(s);
    Answers answers;
    for (const StateRule& rule : workflow_detail::kStateRules) {
      if (rule.step == step && rule.state == state) {
        add(answers, rule.event,
            text_of(rule.action, rule.next == step ? Leads() : Leads(rule.next)));
      }
    }
    if (!answers.empty()) {
      out += item(std::string(name_of(step)) + ", " + std::string(name_of(state)), answers);
    }
  }
  return out;
}

std::string rules_by_step(const auto& rules) {
  std::string out;
  for (std::size_t s = 0; s < kStepCount; ++s) {
    const auto step = static_cast<Step>(s);
    Answers answers;
    for (const Rule& rule : rules) {
      if (rule.step == step) {
        add(answers, rule.event,
            text_of(rule.action, rule.next == step ? Leads() : Leads(rule.next)));
      }
    }
    if (!answers.empty()) {
      out += item(std::string(name_of(step)), answers);
    }
  }
  return out;
}

std::string workflow_text() {
  std::string out = usual_answers();
  for (std::size_t s = 0; s < kStepCount; ++s) {
    out += answers_of(static_cast<Step>(s));
    out += answers_in_states_of(static_cast<Step>(s));
  }
  return out +
         "\nWhere rods alone are bent (`--rods-only`), nothing is registered and no screw is "
         "guided:\n\n" +
         rules_by_step(workflow_detail::kRulesRodsAlone) +
         "\nWhere the eye alone verifies (`paper`), these answers stand instead. A study that "
         "leaves out check points,\nthe landmark or the measurement of wires has the answers of "
         "`verify`, `landmark` or `guide`; without the\nlandmark, that of `digitize`:\n\n" +
         rules_by_step(workflow_detail::kRulesByEye) +
         "\nWhere a study leaves out that the landmark is touched again:\n\n" +
         rules_by_step(workflow_detail::kRulesTouchedOnce) +
         "\nWhere it is touched, and a study leaves out that wires are measured:\n\n" +
         rules_by_step(workflow_detail::kRulesWireUnmeasured);
}

/// Answers while exactly these states hold.
auto in(std::set<State> states) {
  return [states = std::move(states)](State state) { return states.contains(state); };
}

/// No state, and each alone.
std::vector<std::set<State>> every_state() {
  std::vector<std::set<State>> all = {{}};
  for (std::size_t s = 0; s < kStateCount; ++s) {
    all.push_back({static_cast<State>(s)});
  }
  return all;
}

const Workflow& table_of(Verification verification) {
  return verification == Verification::kByEye ? kWorkflowByEye : kWorkflow;
}

TEST(Workflow, IsWrittenDownAsItIs) {
  EXPECT_EQ(written_workflow(), workflow_text())
      << "docs/safety.md is stale; between its two workflow marks belongs:\n"
      << workflow_text();
}

TEST(Workflow, NothingTheEngineFindsOutIsRefusedWhereItCanHappen) {
  // FollowUpEvent by the session itself, in these steps only.
  constexpr std::pair<Step, Event> kRaised[] = {{Step::kRegistering, Event::kRegistered},
                                                {Step::kRegistering, Event::kRegistrationRefused},
                                                {Step::kDigitize, Event::kRegistrationRestored},
                                                {Step::kDigitize, Event::kAcceptanceRestored},
                                                {Step::kDigitize, Event::kNoScrewLeft},
                                                {Step::kDigitize, Event::kNoRodPlanned},
                                                {Step::kTouchLandmark, Event::kLandmarkMoved},
                                                {Step::kGuide, Event::kBoneUnchecked},
                                                {Step::kMeasureWire, Event::kScrewRedone},
                                                {Step::kMeasureWire, Event::kNoOtherEntry},
                                                {Step::kMeasureWire, Event::kAnotherScrew},
                                                {Step::kMeasureWire, Event::kAnotherLevel},
                                                {Step::kMeasureWire, Event::kNoScrewLeft},
                                                {Step::kMeasureWire, Event::kNoRodPlanned},
                                                {Step::kRod, Event::kAnotherSide},
                                                {Step::kRod, Event::kNoSideLeft}};
  for (const auto& [step, event] : kRaised) {
    EXPECT_NE(answer(step, event).action, Action::kRefuse) << name_of(step) << name_of(event);
  }
  // A button has no fixed meaning, so pressing it in another step is not a mistake.
  for (std::size_t s = 0; s < kStepCount; ++s) {
    for (const Event event : {Event::kPress, Event::kRelease, Event::kClick, Event::kHold}) {
      EXPECT_NE(answer(static_cast<Step>(s), event).action, Action::kRefuse) << s;
    }
  }
}

TEST(Workflow, AForgottenCellRefusesAndStays) {
  // No rule is written for this one.
  EXPECT_EQ(answer(Step::kSetup, Event::kSayAccept), (Cell{Step::kSetup, Action::kRefuse}));
  for (std::size_t s = 0; s < kStepCount; ++s) {
    for (const Cell& cell : kWorkflow[s]) {
      if (cell.action == Action::kRefuse) {
        EXPECT_EQ(cell.next, static_cast<Step>(s));
      }
    }
  }
}

TEST(Workflow, EveryStepCanBeReachedAndAllButTheLastCanBeLeft) {
  std::set<Step> reached = {Step::kSetup};
  for (std::size_t round = 0; round < kStepCount; ++round) {
    for (const Step step : std::set<Step>(reached)) {
      for (std::size_t e = 0; e < kEventCount; ++e) {
        for (const auto& states : every_state()) {
          reached.insert(answer(kWorkflow, step, static_cast<Event>(e), in(states)).next);
        }
      }
    }
  }
  EXPECT_EQ(reached.size(), kStepCount);
  for (std::size_t s = 0; s + 1 < kStepCount; ++s) {
    bool leaves = false;
    for (const Cell& cell : kWorkflow[s]) {
      leaves = leaves || cell.next != static_cast<Step>(s);
    }
    EXPECT_TRUE(leaves) << name_of(static_cast<Step>(s));
  }
}

TEST(Workflow, OfRodsAloneReachesTheRodsAndNothingThatNeedsARegistration) {
  std::set<Step> reached = {Step::kSetup};
  std::set<Step> with_levels = {Step::kSetup};
  for (std::size_t round = 0; round < kStepCount; ++round) {
    const auto follow = [](const Workflow& table, std::set<Step>& steps) {
      for (const Step step : std::set<Step>(steps)) {
        for (std::size_t e = 0; e < kEventCount; ++e) {
          for (const auto& states : every_state()) {
            steps.insert(answer(table, step, static_cast<Event>(e), in(states)).next);
          }
        }
      }
    };
    follow(kWorkflowRodsAlone, reached);
    follow(kWorkflow, with_levels);
  }
  EXPECT_EQ(reached, (std::set<Step>{Step::kSetup, Step::kRod, Step::kDone}));
  EXPECT_EQ(with_levels.size(), kStepCount) << "control: the other table reaches them";
}

class EveryVerification : public ::testing::TestWithParam<Verification> {};
INSTANTIATE_TEST_SUITE_P(Workflow, EveryVerification,
                         ::testing::Values(Verification::kByTouch, Verification::kByEye));

TEST_P(EveryVerification, OnlyTheSurgeonsWordLeadsToGuidance) {
  const bool by_touch = GetParam() == Verification::kByTouch;
  const Workflow& table = table_of(GetParam());
  for (std::size_t i = 0; i < kStepCount * kEventCount * every_state().size(); ++i) {
    const std::size_t s = i % kStepCount;
    const std::size_t e = i / kStepCount % kEventCount;
    const auto step = static_cast<Step>(s);
    const auto event = static_cast<Event>(e);
    const std::set<State> states = every_state()[i / kStepCount / kEventCount];
    const Step next = answer(table, step, event, in(states)).next;
    if (!by_touch && step == Step::kMeasureWire) {
      EXPECT_NE(answer(Step::kGuide, event, GetParam()).next, Step::kMeasureWire)
          << "never reached";
      continue;
    }
    if (next == Step::kTouchLandmark && step != Step::kTouchLandmark) {
      const bool after_screw = by_touch && step == Step::kMeasureWire &&
                               (event == Event::kAnotherScrew || event == Event::kScrewRedone);
      const bool drifted = by_touch && step == Step::kGuide && event == Event::kBoneUnchecked;
      // Accepted by the surgeon before the program ended; the landmark shows whether it still
      // holds.
      const bool restored =
          by_touch && step == Step::kDigitize && event == Event::kAcceptanceRestored;
      EXPECT_TRUE(after_screw || drifted || restored ||
                  (step == Step::kVerify && event == Event::kSayAccept &&
                   states.contains(State::kChecksPassed)))
          << s << " " << e;
    }
    if (next == Step::kGuide && step != Step::kGuide) {
      EXPECT_TRUE(step == Step::kTouchLandmark && event == Event::kSayNext &&
                  (!by_touch || states.contains(State::kLandmarkTouched)))
          << s << " " << e;
    }
  }
  EXPECT_EQ(answer(table, Step::kVerify, Event::kSayAccept, in({State::kChecksPassed})),
            (Cell{Step::kTouchLandmark, Action::kAccept}));
  EXPECT_EQ(
      answer(table, Step::kVerify, Event::kSayAccept, in({State::kNotShown, State::kChecksPassed})),
      (Cell{Step::kVerify, Action::kExplainNotShown}));
}

TEST(Workflow, VerifyingByTouchTheWordAloneAcceptsNothing) {
  EXPECT_EQ(answer(Step::kVerify, Event::kSayAccept),
            (Cell{Step::kVerify, Action::kExplainChecks}));
}

TEST(Workflow, AcceptAnswersWhatWasAskedAndAPendingBreachFirst) {
  const auto accepted = [](Step step, std::set<State> states) {
    return answer(kWorkflow, step, Event::kSayAccept, in(std::move(states))).action;
  };
  for (const Step step : {Step::kTouchLandmark, Step::kGuide, Step::kMeasureWire}) {
    EXPECT_EQ(accepted(step, {}), Action::kRefuse) << "nothing was asked";
    EXPECT_EQ(accepted(step, {State::kBreachPending, State::kCorrectionOffered,
                              State::kLandmarkTouched, State::kWireBeyondLimit}),
              Action::kTakeBreach);
  }
  EXPECT_EQ(accepted(Step::kTouchLandmark, {State::kLandmarkTouched}), Action::kRefuse);
  EXPECT_EQ(accepted(Step::kTouchLandmark, {State::kLandmarkTouched, State::kCorrectionOffered}),
            Action::kCorrectGuide);
  EXPECT_EQ(accepted(Step::kMeasureWire, {State::kWireBeyondLimit}), Action::kKeepWire);
}

TEST(Workflow, BeforeEveryScrewTheLandmarkIsTouched) {
  for (const Event event : {Event::kAnotherScrew, Event::kScrewRedone}) {
    EXPECT_EQ(answer(Step::kMeasureWire, event),
              (Cell{Step::kTouchLandmark, Action::kExpectLandmark}));
  }
  EXPECT_EQ(answer(Step::kTouchLandmark, Event::kSayNext),
            (Cell{Step::kTouchLandmark, Action::kExplainLandmark}));
  EXPECT_EQ(answer(kWorkflow, Step::kTouchLandmark, Event::kSayNext, in({State::kLandmarkTouched})),
            (Cell{Step::kGuide, Action::kSelectScrew}));
  EXPECT_EQ(answer(Step::kTouchLandmark, Event::kLandmarkMoved),
            (Cell{Step::kVerify, Action::kVerifyAgain}));
  EXPECT_EQ(answer(Step::kTouchLandmark, Event::kSayNext, Verification::kByEye),
            (Cell{Step::kGuide, Action::kSelectScrew}));
}

TEST(Workflow, AfterEveryScrewItsWireIsLookedAt) {
  EXPECT_EQ(answer(Step::kGuide, Event::kSayNext), (Cell{Step::kMeasureWire, Action::kExpectWire}));
  EXPECT_EQ(answer(Step::kMeasureWire, Event::kSayNext),
            (Cell{Step::kMeasureWire, Action::kFinishScrew}));
  EXPECT_EQ(answer(kWorkflow, Step::kMeasureWire, Event::kSayNext, in({State::kWireBeyondLimit})),
            (Cell{Step::kMeasureWire, Action::kExplainWire}));
  EXPECT_EQ(answer(Step::kGuide, Event::kAnotherScrew).action, Action::kRefuse);
  EXPECT_EQ(answer(Step::kGuide, Event::kSayNext, Verification::kByEye),
            (Cell{Step::kGuide, Action::kFinishScrew}));
}

TEST(Workflow, VerifyingByEyeDiffersInVerifyLandmarkAndWire) {
  for (std::size_t s = 0; s < kStepCount; ++s) {
    for (std::size_t e = 0; e < kEventCount; ++e) {
      const auto step = static_cast<Step>(s);
      const auto event = static_cast<Event>(e);
      const bool after_screw =
          step == Step::kGuide && (event == Event::kSayNext || event == Event::kAnotherScrew ||
                                   event == Event::kAnotherLevel || event == Event::kNoScrewLeft ||
                                   event == Event::kNoRodPlanned || event == Event::kBoneUnchecked);
      // There is no landmark to show it.
      const bool restored = step == Step::kDigitize && event == Event::kAcceptanceRestored;
      if (step == Step::kVerify || step == Step::kTouchLandmark || after_screw || restored) {
        continue;
      }
      EXPECT_EQ(answer(step, event, Verification::kByEye), answer(step, event)) << s << " " << e;
    }
  }
  // The published method has nothing to click and nothing to take back.
  for (const Event event : {Event::kPress, Event::kRelease, Event::kClick, Event::kHold}) {
    for (const Step step : {Step::kVerify, Step::kTouchLandmark}) {
      EXPECT_EQ(answer(step, event, Verification::kByEye), (Cell{step, Action::kIgnore}));
    }
  }
  EXPECT_EQ(answer(Step::kVerify, Event::kSayDelete, Verification::kByEye).action, Action::kRefuse);
}

TEST(Workflow, LosingAToolNeverChangesTheStep) {
  for (std::size_t s = 0; s < kStepCount; ++s) {
    for (const Event event : {Event::kTrackingLost, Event::kPoseStale, Event::kTrackingRegained}) {
      const Cell cell = answer(static_cast<Step>(s), event);
      EXPECT_EQ(cell.next, static_cast<Step>(s));
      EXPECT_NE(cell.action, Action::kRefuse) << "what tracking finds out can't be refused";
    }
  }
}

TEST(Workflow, AStalePoseHidesWhereverAToolIsUsed) {
  for (const Step step : {Step::kDigitize, Step::kRegistering, Step::kVerify, Step::kTouchLandmark,
                          Step::kGuide, Step::kMeasureWire, Step::kRod}) {
    EXPECT_EQ(answer(step, Event::kPoseStale).action, Action::kHideGuidance) << name_of(step);
  }
}

TEST(Workflow, OnlyItsAnswerOrALostPlaceEndsARegistration) {
  for (std::size_t e = 0; e < kEventCount; ++e) {
    const auto event = static_cast<Event>(e);
    const bool ends = event == Event::kRegistered || event == Event::kRegistrationRefused ||
                      event == Event::kMapMoved || event == Event::kReferenceMoved;
    EXPECT_EQ(answer(Step::kRegistering, event).next != Step::kRegistering, ends) << name_of(event);
  }
}

TEST(Workflow, NamesAreDistinct) {
  std::set<std::string_view> names;
  for (std::size_t e = 0; e < kEventCount; ++e) {
    names.insert(name_of(static_cast<Event>(e)));
  }
  EXPECT_EQ(names.size(), kEventCount);
  names.clear();
  for (std::size_t a = 0; a < kActionCount; ++a) {
    names.insert(name_of(static_cast<Action>(a)));
  }
  EXPECT_EQ(names.size(), kActionCount);
  names.clear();
  for (std::size_t s = 0; s < kStateCount; ++s) {
    names.insert(name_of(static_cast<State>(s)));
  }
  EXPECT_EQ(names.size(), kStateCount);
}

}  // namespace
}  // namespace orthonav::engine::workflow_test
