#include <gtest/gtest.h>

#include "engine/holograms/scene_builder.h"
#include "tests/engine/session/journaled_operation.h"
#include "tests/support/temporary_folder.h"
#include "tests/tools/language/pseudo_language.h"

namespace orthonav::engine::translated_journal_test {
namespace {

/// The journal of an operation with a refusal, while its scenes are drawn for a wearer.
std::string journal_of_an_operation() {
  journal_reader_test::Journaled s({"L4"}, Verification::kByTouch);
  SceneBuilder builder;
  render::Scene scene;
  const auto draw = [&](const Guidance& guidance) {
    builder.update(guidance);
    builder.write_scene(guidance, scene);
  };
  s.operation.registration.reasons = {{nav::RefusalReason::Kind::kNoise, 0.004, 0.003, {}, {}, {}}};
  s.operation.registration.accepted = false;
  draw(s.operation.registers_first_level());
  s.operation.registration.reasons.clear();
  s.operation.registration.accepted = true;
  draw(s.operation.does({ClickerAction::kDoubleClick}));
  draw(s.operation.checks_by_touch());
  draw(s.operation.accepts());
  s.finished("ended by the test");
  return test::content_of(s.path);
}

TEST(TranslatedJournal, IsThatOfTheSameOperationInEnglish) {
  const std::string english = journal_of_an_operation();
  EXPECT_NE(english.find("the points scatter 4.0 mm"), std::string::npos) << english;
  const test::PseudoLanguage pseudo;
  EXPECT_EQ(journal_of_an_operation(), english);
}

}  // namespace
}  // namespace orthonav::engine::translated_journal_test
