#include "tools/preview/script.h"

#include <gmock/gmock.h>

#include "tests/tools/preview/model_bench.h"

namespace orthonav::preview::script_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Bench : ModelBench {
  std::vector<std::string> taken;
  ScriptStage stage{[this](int w, int h) { taken.push_back(std::to_string(w * 10000 + h)); },
                    [this](const std::string& name) { taken.push_back(name); }};

  Status advance(Script& script, bool ended = false) {
    return script.advance(model, stage, wall.now(), ended);
  }
  void show(int pair, const engine::StepOnDisplay& at) {
    gate.pass(Timestamp(Duration(pair)));
    auto moment = std::make_shared<Moment>();
    moment->pair = pair;
    moment->at = at;
    timeline.push(moment);
  }
};

TEST(Script, WaitsForAStepAndTakesOnePictureACall) {
  Bench bench;
  Script script =
      Script::parse("until digitize # a remark\nscreenshot a.png\nresize 640 480\nkey s\n", "t")
          .value();
  ASSERT_TRUE(bench.advance(script).ok());
  bench.show(1, {engine::Step::kSetup, {}, {}});
  ASSERT_TRUE(bench.advance(script).ok());
  EXPECT_TRUE(bench.taken.empty());
  bench.show(2, {engine::Step::kDigitize, "L4", {}});
  ASSERT_TRUE(bench.advance(script).ok());
  EXPECT_THAT(bench.taken, ElementsAre("a.png"));
  ASSERT_TRUE(bench.advance(script).ok());
  EXPECT_THAT(bench.taken, ElementsAre("a.png", "6400480"));
  EXPECT_FALSE(script.done());
  ASSERT_TRUE(bench.advance(script).ok());
  EXPECT_TRUE(script.done());
  std::vector<std::string> said;
  bench.keyboard.take_phrases(said);
  EXPECT_THAT(said, ElementsAre("start"));
}

TEST(Script, SaysWholePhrases) {
  Bench bench;
  Script script = Script::parse("say screw six forty five\nkey z\nkey y\n", "t").value();
  ASSERT_TRUE(bench.advance(script).ok());
  EXPECT_TRUE(script.done());
  std::vector<std::string> said;
  bench.keyboard.take_phrases(said);
  EXPECT_THAT(said, ElementsAre("screw six forty five", "undo", "move cranial one"));
  EXPECT_FALSE(Script::parse("say\n", "t").ok());
}

TEST(Script, CountsPairsFromWhereItWaits) {
  Bench bench;
  bench.show(1, {engine::Step::kSetup, {}, {}});
  Script script = Script::parse("pairs 2\n", "t").value();
  ASSERT_TRUE(bench.advance(script).ok());
  bench.show(2, {engine::Step::kSetup, {}, {}});
  ASSERT_TRUE(bench.advance(script).ok());
  EXPECT_FALSE(script.done());
  bench.show(3, {engine::Step::kSetup, {}, {}});
  ASSERT_TRUE(bench.advance(script).ok());
  EXPECT_TRUE(script.done());
}

TEST(Script, PausesUntilNothingMovesAnyMore) {
  Bench bench;
  bench.show(1, {engine::Step::kSetup, {}, {}});
  bench.gate.set_speed(0.0);
  ASSERT_TRUE(bench.gate.may_pass());  // A pair is on its way.
  Script script = Script::parse("pause\n", "t").value();
  ASSERT_TRUE(bench.advance(script).ok());
  EXPECT_FALSE(script.done());
  bench.gate.pass(Timestamp(Duration(5)));  // It arrived, and is being processed.
  ASSERT_TRUE(bench.advance(script).ok());
  EXPECT_FALSE(script.done());
  auto moment = std::make_shared<Moment>();
  moment->pair = 2;
  bench.timeline.push(moment);
  ASSERT_TRUE(bench.advance(script).ok());
  EXPECT_TRUE(script.done());
}

TEST(Script, GivesUpWhenNothingMoreComesOrItTakesTooLong) {
  Bench bench;
  Script script = Script::parse("\nuntil done\n", "steps.txt").value();
  ASSERT_TRUE(bench.advance(script).ok());
  bench.wall.advance(std::chrono::seconds(301));
  const Status late = bench.advance(script);
  ASSERT_FALSE(late.ok());
  EXPECT_THAT(late.error().message, HasSubstr("steps.txt:2: until: waited 301"));
  const Status over = bench.advance(script, true);
  ASSERT_FALSE(over.ok());
  EXPECT_THAT(over.error().message, HasSubstr("waits for done, but nothing more comes"));
}

TEST(Script, RefusesWhatItDoesNotKnow) {
  for (const char* bad : {"jump", "key", "key hyper", "pairs", "pairs x", "resize 3",
                          "resize 3 4 5", "until", "screenshot", "show all", "pause 3"}) {
    const auto script = Script::parse(std::string("key s\n") + bad, "t");
    ASSERT_FALSE(script.ok()) << bad;
    EXPECT_THAT(script.error().message, HasSubstr("t:2: ")) << bad;
  }
}

TEST(Script, RefusesNumbersThatNothingCanHave) {
  for (const char* bad :
       {"resize 63 480",   "resize 640 16385", "resize -1 480", "resize 640.5 480",
        "resize 1e99 480", "resize nan 480",   "show 0",        "show 14",
        "show 99",         "hide -3",          "hide 1.5",      "pairs -1",
        "pairs 2.5",       "pairs 1000001",    "pairs 7 8",     "scrub -1",
        "wait -1",         "wait 1e9",         "zoom 101",      "zoom inf",
        "drag 1e9 0",      "drag 0 nan",       "drag 1 2 3",    "zoom 3x"}) {
    const auto script = Script::parse(std::string("key s\n") + bad, "t");
    ASSERT_FALSE(script.ok()) << bad;
    EXPECT_THAT(script.error().message, HasSubstr("t:2: ")) << bad;
  }
  EXPECT_EQ(Script::parse("show 99", "t").error().message,
            "t:1: show: 99 must be a whole number from 1 to 13");
  EXPECT_EQ(Script::parse("\nresize 63 480", "t").error().message,
            "t:2: resize: 63 must be a whole number from 64 to 16384");
  for (const char* good : {"resize 64 16384", "show 1", "hide 13", "pairs 0", "pairs 1000000",
                           "scrub 0", "wait 0", "zoom -100", "drag -10000 0.5"}) {
    EXPECT_TRUE(Script::parse(good, "t").ok()) << good;
  }
}

}  // namespace
}  // namespace orthonav::preview::script_test
