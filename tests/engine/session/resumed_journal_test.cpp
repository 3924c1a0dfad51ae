// The journal of an operation continued by another program.
#include <gmock/gmock.h>

#include "engine/session/journal.h"
#include "engine/session/journal_reader.h"
#include "engine/session/observer_list.h"
#include "tests/support/is_ok.h"
#include "tests/support/resumed_operation.h"
#include "tests/support/scripted_surgeon.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::engine::resumed_journal_test {
namespace {

using test::is_ok;
using ::testing::HasSubstr;
using ::testing::Not;

/// The second journal of an operation that was killed in that step of the first level and then
/// continued to the end.
std::string second_journal(Step killed_in, Step ends_in = Step::kDone) {
  test::MemoryEnv env;
  {
    auto s = test::touched_operation(true);
    auto log = test::log_of(*s, env, true);
    test::ScriptedSurgeon surgeon(*s);
    while (s->session().current_step() != killed_in && surgeon.act()) {
    }
  }
  const test::TemporaryFolder folder;
  const std::string path = folder.file("session.orthonav");
  test::MemoryEnv disk(env.files());
  test::ResumedOperation r(disk, true);
  EXPECT_TRUE(is_ok(r.resumed));
  JournalHeader header{"0.1.0", "fake", "scripted", "boxes", 0, 0, {}};
  header.patient_reference = true;
  for (const LevelState& level : r.operation->session().levels()) {
    header.levels.push_back(planned(level.plan.label, level.plan.screws));
  }
  const auto journal = Journal::create(path, header).value();
  ObserverList both({journal.get(), r.log.get()});
  r.operation->session().observe(&both);
  test::ScriptedSurgeon surgeon(*r.operation);
  while (r.operation->session().current_step() != ends_in && surgeon.act()) {
  }
  EXPECT_TRUE(is_ok(journal->finish({})));
  const auto read = read_journal(path);
  EXPECT_TRUE(is_ok(read));
  if (read && ends_in != Step::kDone) {
    EXPECT_TRUE(read->levels.at(0).accepted) << "in the session before, and not taken back";
  } else if (read) {
    EXPECT_TRUE(read->levels.at(0).accepted);
    EXPECT_TRUE(read->levels.at(0).registration.has_value()) << "as it was restored";
    EXPECT_TRUE(read->levels.at(1).registration.has_value());
    EXPECT_EQ(read->registrations.size(), 2u) << "each told once";
  }
  return test::content_of(path);
}

TEST(ResumedJournal, TellsTheRestoredRegistrationBeforeWhatHangsOnIt) {
  for (const Step step : {Step::kVerify, Step::kAccepted, Step::kGuide, Step::kPlaced}) {
    const std::string journal = second_journal(step);
    const std::size_t restored = journal.find("\"restored\":true");
    ASSERT_NE(restored, std::string::npos);
    EXPECT_EQ(journal.find("\"restored\"", restored + 1), std::string::npos)
        << "L5 was registered in this one";
  }
}

TEST(ResumedJournal, HasALevelAsAcceptedThatWasAcceptedInAnEarlierOne) {
  for (const Step step : {Step::kAccepted, Step::kGuide, Step::kPlaced}) {
    second_journal(step, Step::kGuide);
  }
}

TEST(ResumedJournal, HasALevelAsAcceptedThatWasFinishedInAnEarlierOne) {
  second_journal(Step::kRod, Step::kRod);
}

TEST(ResumedJournal, RestoresNothingThatIsStrokedAgain) {
  EXPECT_THAT(second_journal(Step::kDigitize), Not(HasSubstr("restored")));
}

}  // namespace
}  // namespace orthonav::engine::resumed_journal_test
