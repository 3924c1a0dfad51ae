#include <gmock/gmock.h>

#include "engine/holograms/visibility.h"
#include "engine/session/text/wording.h"
#include "engine/session/work_watch.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine {
namespace {

using test::pointer_at;
using test::ScriptedOperation;
using enum ClickerAction;
using ::testing::StartsWith;

TEST(Stall, OfAnyPartIsNamedFirstAndHidesEverythingElse) {
  for (std::size_t i = 0; i < kPartCount; ++i) {
    const auto part = static_cast<Part>(i);
    ScriptedOperation s;
    s.accepts_first_level();
    s.says("next");
    s.tracker().guide = test::guide_at({0.015, 0.020, 0.0}, 0.1);
    ASSERT_TRUE(s.pair().tool.has_value());
    s.stalled = part;
    const Guidance& g = s.pair();
    EXPECT_FALSE(g.tool.has_value());
    EXPECT_TRUE(g.blank);
    EXPECT_THAT(detail_text(g.status), StartsWith(std::string(word_of(part)) + " stalled"));
    s.stalled.reset();
    const Guidance& after = s.pair();
    EXPECT_TRUE(after.tool.has_value());
    EXPECT_FALSE(after.blank);
  }
}

TEST(Stall, HidesARegistrationSoThatItCannotBeAccepted) {
  for (const bool stalled : {true, false}) {
    ScriptedOperation s;
    s.tracker().pointer = pointer_at({0, 0.02, 0});
    s.says("start");
    s.strokes(5);
    s.says("save");
    s.stalled = stalled ? std::optional(Part::kRenderer) : std::nullopt;
    s.does({kDoubleClick});
    const Timestamp while_hidden = s.pairs(5).display_time;
    s.stalled.reset();
    s.hears_at(while_hidden, "accept");
    EXPECT_EQ(s.pair().step, stalled ? Step::kVerify : Step::kTouchLandmark);
    s.pairs(3);
    EXPECT_EQ(s.says("accept").step, Step::kTouchLandmark) << "once it was seen, it counts";
  }
}

}  // namespace
}  // namespace orthonav::engine
