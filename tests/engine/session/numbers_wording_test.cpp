#include "engine/session/numbers_wording.h"

#include <gtest/gtest.h>

#include <cmath>

namespace orthonav::engine::numbers_wording_test {
namespace {

std::string row_text(const nav::ScrewNumbers& numbers, NumberRow row) {
  std::string out;
  append_number(out, numbers, row);
  return out;
}

std::string line_text(const nav::ScrewNumbers& numbers, bool registration_only) {
  std::string out;
  append_numbers(out, numbers, registration_only);
  return out;
}

constexpr nav::ScrewNumbers kSure{{12, 3, true}, {8, 3, true}, {-21, 5, true}, {-4, 5, true}};

TEST(NumbersWording, SaysMillimetresAndDegreesWithTheirDirections) {
  EXPECT_EQ(line_text(kSure, false),
            "tip 1.2 mm cranial, 0.8 mm medial; aims 2.1° caudal, 0.4° lateral");
  EXPECT_EQ(line_text({{-12, 3, true}, {-8, 3, true}, {21, 5, true}, {4, 5, true}}, false),
            "tip 1.2 mm caudal, 0.8 mm lateral; aims 2.1° cranial, 0.4° medial");
}

TEST(NumbersWording, GivesZeroNoDirection) {
  EXPECT_EQ(row_text({{0, 3, true}, {}, {}, {}}, NumberRow::kTipCranial), "0.0 mm");
  EXPECT_EQ(row_text({{}, {}, {}, {0, 3, true}}, NumberRow::kAimMedial), "0.0°");
}

TEST(NumbersWording, SaysHowUnsureANumberIs) {
  nav::ScrewNumbers numbers = kSure;
  numbers.tip_cranial = {12, 14, false};
  numbers.aim_medial = {-4, std::nullopt, false};
  EXPECT_EQ(row_text(numbers, NumberRow::kTipCranial), "1.2 ± 1.4 mm cranial");
  EXPECT_EQ(row_text(numbers, NumberRow::kAimMedial), "0.4 ± --° lateral");
  EXPECT_EQ(line_text(numbers, true),
            "tip 1.2 ± 1.4 mm cranial, 0.8 mm medial; aims 2.1° caudal, 0.4 ± --° lateral "
            "(registration only)");
  EXPECT_EQ(line_text(kSure, true), line_text(kSure, false)) << "without an SD, nothing to add";
}

std::string depth_text(const nav::ShownDepth& depth) {
  std::string out;
  append_depth(out, depth);
  return out;
}

TEST(NumbersWording, SaysWhatIsLeftToDrillAndHowUnsureThatIs) {
  EXPECT_EQ(depth_text({nav::DepthTo::kEntry, 123, 4, true}), "12.3 mm to entry");
  EXPECT_EQ(depth_text({nav::DepthTo::kTarget, 0, 4, true}), "0.0 mm to target");
  EXPECT_EQ(depth_text({nav::DepthTo::kPastTarget, 12, 14, false}), "1.2 ± 1.4 mm past target");
  EXPECT_EQ(depth_text({nav::DepthTo::kTarget, 310, std::nullopt, false}),
            "31.0 ± -- mm to target");
}

std::string clearance_text(const nav::ShownClearance& clearance, bool registration_only = false) {
  std::string out;
  append_clearance_line(out, clearance, registration_only);
  return out;
}

TEST(NumbersWording, SaysTheClearanceAndWhereAScrewMayBreakThrough) {
  EXPECT_EQ(clearance_text({24, 11, "medial"}), "clearance 2.4 mm, at least 1.1 mm");
  EXPECT_EQ(clearance_text({24, std::nullopt, "medial"}), "clearance 2.4 mm");
  EXPECT_EQ(clearance_text({24, 11, "medial"}, true),
            "clearance 2.4 mm, at least 1.1 mm (registration only)");
  EXPECT_EQ(clearance_text({24, std::nullopt, "medial"}, true), "clearance 2.4 mm");
  EXPECT_EQ(clearance_text({4, 0, "medial"}), "clearance 0.4 mm, at least 0.0 mm");
  EXPECT_EQ(clearance_text({4, -1, "medial"}), "clearance 0.4 mm: may break through medially");
  EXPECT_EQ(clearance_text({-4, -9, "caudal"}), "clearance −0.4 mm: breaks through caudally");
  EXPECT_EQ(clearance_text({3, -1, "tip"}), "clearance 0.3 mm: may break through at its tip");
}

std::string drill_text(nav::DrillPhase phase, nav::DrillAlarm alarm, bool watched) {
  std::string out;
  append_drill(out, {phase, alarm, watched});
  return out;
}

TEST(NumbersWording, SaysHowTheDrillGoes) {
  using enum nav::DrillPhase;
  using enum nav::DrillAlarm;
  EXPECT_EQ(drill_text(kAway, kNone, true), "");
  EXPECT_EQ(drill_text(kSet, kNone, true), "tip set");
  EXPECT_EQ(drill_text(kSet, kNone, false), "");
  EXPECT_EQ(drill_text(kDrilling, kNone, true), "drilling");
  EXPECT_EQ(drill_text(kDrilling, kNone, false), "drilling, tool not seen");
  EXPECT_EQ(drill_text(kDrilling, kAmber, true), "drilling: drifting");
  EXPECT_EQ(drill_text(kDrilling, kRed, true), "drilling: off plan");
  EXPECT_EQ(drill_text(kDrilling, kStop, true), "stop");
  EXPECT_EQ(drill_text(kDrilling, kStop, false), "stop, tool not seen");
}

TEST(NumbersWording, SaysWhatTheNumberSays) {
  EXPECT_NEAR(reading_of(kSure, NumberRow::kTipCranial), 0.0012, 1e-15);
  EXPECT_NEAR(reading_of(kSure, NumberRow::kAimCranial), -2.1 * 3.14159265358979 / 180.0, 1e-12);
}

}  // namespace
}  // namespace orthonav::engine::numbers_wording_test
