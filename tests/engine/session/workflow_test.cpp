#include "engine/session/workflow.h"

#include <gmock/gmock.h>

#include <fstream>
#include <set>
#include <sstream>

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

TEST(Workflow, IsWrittenDownAsItIs) {
  EXPECT_EQ(written_workflow(), workflow_diagram())
      << "docs/safety.md is stale; between its two workflow marks belongs:\n"
      << workflow_diagram();
}

TEST(Workflow, NothingTheEngineFindsOutIsRefusedWhereItCanHappen) {
  // Raised by the session itself, in these steps only.
  constexpr std::pair<Step, Event> kRaised[] = {{Step::kRegistering, Event::kRegistered},
                                                {Step::kRegistering, Event::kRegistrationRefused},
                                                {Step::kDigitize, Event::kRegistrationRestored},
                                                {Step::kDigitize, Event::kAcceptanceRestored},
                                                {Step::kDigitize, Event::kNoScrewLeft},
                                                {Step::kDigitize, Event::kNoRodPlanned},
                                                {Step::kVerify, Event::kChecked},
                                                {Step::kVerify, Event::kNotChecked},
                                                {Step::kAccepted, Event::kLandmarkTouched},
                                                {Step::kAccepted, Event::kLandmarkMissing},
                                                {Step::kAccepted, Event::kLandmarkMoved},
                                                {Step::kGuide, Event::kBoneUnchecked},
                                                {Step::kPlaced, Event::kWireSettled},
                                                {Step::kPlaced, Event::kWireUndecided},
                                                {Step::kPlaced, Event::kScrewRedone},
                                                {Step::kPlaced, Event::kNoOtherEntry},
                                                {Step::kPlaced, Event::kAnotherScrew},
                                                {Step::kPlaced, Event::kAnotherLevel},
                                                {Step::kPlaced, Event::kNoScrewLeft},
                                                {Step::kPlaced, Event::kNoRodPlanned},
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
        reached.insert(answer(step, static_cast<Event>(e)).next);
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
          steps.insert(answer(table, step, static_cast<Event>(e)).next);
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
  // The event raised on "accept" when the touched places confirm it, otherwise "accept" itself.
  const bool by_touch = GetParam() == Verification::kByTouch;
  const Event accepting = by_touch ? Event::kChecked : Event::kSayAccept;
  // The event raised on "next" once the landmark was found.
  const Event guiding = by_touch ? Event::kLandmarkTouched : Event::kSayNext;
  for (std::size_t s = 0; s < kStepCount; ++s) {
    for (std::size_t e = 0; e < kEventCount; ++e) {
      const auto step = static_cast<Step>(s);
      const auto event = static_cast<Event>(e);
      const Step next = answer(step, event, GetParam()).next;
      if (!by_touch && step == Step::kPlaced) {
        EXPECT_NE(answer(Step::kGuide, event, GetParam()).next, Step::kPlaced) << "never reached";
        continue;
      }
      if (next == Step::kAccepted && step != Step::kAccepted) {
        const bool after_screw = by_touch && step == Step::kPlaced &&
                                 (event == Event::kAnotherScrew || event == Event::kScrewRedone);
        const bool drifted = by_touch && step == Step::kGuide && event == Event::kBoneUnchecked;
        // Accepted by the surgeon before the program ended; the landmark shows whether it still
        // holds.
        const bool restored =
            by_touch && step == Step::kDigitize && event == Event::kAcceptanceRestored;
        EXPECT_TRUE(after_screw || drifted || restored ||
                    (step == Step::kVerify && event == accepting))
            << s << " " << e;
      }
      if (next == Step::kGuide && step != Step::kGuide) {
        EXPECT_TRUE(step == Step::kAccepted && event == guiding) << s << " " << e;
      }
    }
  }
  EXPECT_EQ(answer(Step::kVerify, accepting, GetParam()), (Cell{Step::kAccepted, Action::kAccept}));
}

TEST(Workflow, VerifyingByTouchTheWordAloneAcceptsNothing) {
  EXPECT_EQ(answer(Step::kVerify, Event::kSayAccept), (Cell{Step::kVerify, Action::kJudgeChecks}));
  EXPECT_EQ(answer(Step::kVerify, Event::kNotChecked).next, Step::kVerify);
}

TEST(Workflow, BeforeEveryScrewTheLandmarkIsTouched) {
  for (const Event event : {Event::kAnotherScrew, Event::kScrewRedone}) {
    EXPECT_EQ(answer(Step::kPlaced, event), (Cell{Step::kAccepted, Action::kExpectLandmark}));
  }
  EXPECT_EQ(answer(Step::kAccepted, Event::kSayNext),
            (Cell{Step::kAccepted, Action::kJudgeLandmark}));
  EXPECT_EQ(answer(Step::kAccepted, Event::kLandmarkMoved),
            (Cell{Step::kVerify, Action::kVerifyAgain}));
  EXPECT_EQ(answer(Step::kAccepted, Event::kSayNext, Verification::kByEye),
            (Cell{Step::kGuide, Action::kSelectScrew}));
}

TEST(Workflow, AfterEveryScrewItsWireIsLookedAt) {
  EXPECT_EQ(answer(Step::kGuide, Event::kSayNext), (Cell{Step::kPlaced, Action::kExpectWire}));
  EXPECT_EQ(answer(Step::kPlaced, Event::kSayNext), (Cell{Step::kPlaced, Action::kJudgeWire}));
  EXPECT_EQ(answer(Step::kPlaced, Event::kWireUndecided).next, Step::kPlaced);
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
      if (step == Step::kVerify || step == Step::kAccepted || after_screw || restored) {
        continue;
      }
      EXPECT_EQ(answer(step, event, Verification::kByEye), answer(step, event)) << s << " " << e;
    }
  }
  // The published method has nothing to click and nothing to take back.
  for (const Event event : {Event::kPress, Event::kRelease, Event::kClick, Event::kHold}) {
    for (const Step step : {Step::kVerify, Step::kAccepted}) {
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
  for (const Step step : {Step::kDigitize, Step::kRegistering, Step::kVerify, Step::kAccepted,
                          Step::kGuide, Step::kPlaced, Step::kRod}) {
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
}

}  // namespace
}  // namespace orthonav::engine::workflow_test
