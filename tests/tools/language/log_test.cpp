#include <gtest/gtest.h>

#include "engine/holograms/scene_builder.h"
#include "tests/support/logged_operation.h"
#include "tests/support/memory_env.h"
#include "tests/tools/language/pseudo_language.h"

namespace orthonav::engine::translated_log_test {
namespace {

/// The log of an operation with a refusal, while its scenes are drawn for a wearer.
std::string log_of_an_operation() {
  test::MemoryEnv env;
  test::ScriptedOperation s({"L4"}, {}, Verification::kByTouch);
  const auto log = test::log_of(s, env);
  SceneBuilder builder;
  render::Scene scene;
  const auto draw = [&](const Guidance& guidance) {
    builder.update(guidance);
    builder.write_scene(guidance, scene);
  };
  s.registration.reasons = {{nav::RefusalReason::Kind::kNoise, 0.004, 0.003, {}, {}, {}}};
  s.registration.accepted = false;
  draw(s.registers_first_level());
  s.registration.reasons.clear();
  s.registration.accepted = true;
  draw(s.does({ClickerAction::kDoubleClick}));
  draw(s.checks_by_touch());
  draw(s.accepts());
  EXPECT_TRUE(log->finish(false, "ended by the test").ok());
  return env.files().at(test::kLogPath);
}

TEST(TranslatedLog, IsThatOfTheSameOperationInEnglish) {
  const std::string english = log_of_an_operation();
  EXPECT_NE(english.find("the points scatter 4.0 mm"), std::string::npos) << english;
  const test::PseudoLanguage pseudo;
  EXPECT_EQ(log_of_an_operation(), english);
}

}  // namespace
}  // namespace orthonav::engine::translated_log_test
