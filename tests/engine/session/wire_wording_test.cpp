#include <gtest/gtest.h>

#include "base/angle.h"
#include "tests/engine/session/status_wording.h"

namespace orthonav::engine::wording_test {
namespace {

TEST(Wording, AsksForTheSleeveAndTellsHowTheWireStands) {
  EXPECT_EQ(line_with(WireSoFar{}), "sleeve over wire, turn, click");
  const PlacedWire within = wire_off(0.8, 0.0006);
  EXPECT_EQ(line_with(WireSoFar{&within}), "say go to next");
  const PlacedWire turned = wire_off(2.04, 0.0006);
  EXPECT_EQ(line_with(WireSoFar{&turned}),
            "angle 2.04°, limit 2.00°: say accept result "
            "to keep it, delete last to redo it");
  PlacedWire off = wire_off(2.6, 0.0031);
  EXPECT_EQ(line_with(WireSoFar{&off, true}),
            "angle 2.6°, limit 2.0°; entry 3.1 mm, "
            "limit 2.0 mm: no other entry stays inside the bone, say accept result to keep it");
  off.kept = true;
  EXPECT_EQ(line_with(WireSoFar{&off}),
            "angle 2.6°, limit 2.0°; entry 3.1 mm, "
            "limit 2.0 mm: kept, say go to next");
  StatusLine lost;
  lost.tool = "guide";
  lost.tool_lost = true;
  lost.state = WireSoFar{};
  EXPECT_EQ(detail_text(lost), "guide lost; sleeve over wire, turn, click");
}

TEST(Wording, SaysWhyAWireWasNotMeasuredAndWhatBecomesOfIt) {
  using Kind = TouchRefusal::Kind;
  const auto refused = [](const TouchRefusal& why) {
    return line_with(Message(TouchNotRecorded{TouchNotRecorded::What::kWire, why}));
  };
  const double deg = kRadiansPerDegree;
  EXPECT_EQ(refused({Kind::kGuideNotSeen}), "wire not recorded: guide was hidden during the press");
  EXPECT_EQ(refused({Kind::kReferenceNotSeen}), "wire not recorded: reference not seen");
  EXPECT_EQ(refused({Kind::kSleeveTurned, 0.0, 0.0, 1.4 * deg, 1.0 * deg}),
            "wire not recorded: sleeve turned 1.4°, limit 1.0°");
  EXPECT_EQ(refused({Kind::kOffTheScrew, 0.021, 0.015}),
            "wire not recorded: sleeve 21 mm off the entry, limit 15 mm");
  EXPECT_EQ(refused({Kind::kAcrossTheScrew, 0.0, 0.0, 41.0 * deg, 30.0 * deg}),
            "wire not recorded: sleeve 41° off the plan, limit 30°");
  EXPECT_EQ(refused({Kind::kEntryUnsure, 0.0018, 0.0015}),
            "wire not recorded: place known to ± 1.8 mm, limit 1.5 mm");
  EXPECT_EQ(refused({Kind::kEntryUnsure, kInfinite, 0.0015}),
            "wire not recorded: registration uncertainty unknown");
  EXPECT_EQ(refused({Kind::kAngleUnsure, 0.0, 0.0, 1.8 * deg, 1.5 * deg}),
            "wire not recorded: angle known to ± 1.8°, limit 1.5°");
  EXPECT_EQ(line_with(Message(NothingToDelete{NothingToDelete::What::kWire})),
            "measure the wire first");
  EXPECT_EQ(line_with(Message(WireUndecided{})),
            "not yet: say accept result to keep it, delete last to redo it");
  EXPECT_EQ(line_with(Message(NoOtherEntry{})),
            "no other entry stays inside the bone, say accept result to keep it");
  EXPECT_EQ(line_with(Message(ConfirmRedo{1})),
            "redone once already: say delete last again to redo it, accept result to keep it");
  EXPECT_EQ(line_with(Message(ConfirmRedo{2})),
            "redone 2 times already: say delete last again to redo it, accept result to keep it");
  EXPECT_EQ(line_with(Message(ScrewRedone{0.0034, 0.0018})),
            "new entry 3.4 mm from the hole, clearance 1.8 mm: take the wire out and touch the "
            "landmark");
}

}  // namespace
}  // namespace orthonav::engine::wording_test
