#include "engine/session/steps/guiding.h"

#include <gtest/gtest.h>

namespace orthonav::engine::numbers_wording_test {
namespace {

std::string row_text(const nav::ScrewNumbers& numbers, NumberRow row) {
  std::string out;
  append_number(out, numbers, row);
  return out;
}

constexpr nav::ScrewNumbers kSure{{12, 3, true}, {8, 3, true}, {-21, 5, true}, {-4, 5, true}};

TEST(NumbersWording, SaysMillimetresAndDegreesWithTheirDirections) {
  EXPECT_EQ(row_text(kSure, NumberRow::kTipCranial), "1.2 mm cranial");
  EXPECT_EQ(row_text(kSure, NumberRow::kAimMedial), "0.4° lateral");
  EXPECT_EQ(row_text({{-12, 3, true}, {}, {}, {}}, NumberRow::kTipCranial), "1.2 mm caudal");
  EXPECT_EQ(row_text({{}, {}, {}, {4, 5, true}}, NumberRow::kAimMedial), "0.4° medial");
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
}

std::string depth_text(const nav::ShownDepth& depth) {
  std::string out;
  append_depth(out, depth);
  return out;
}

TEST(NumbersWording, SaysWhatIsLeftToDrillOrAtLeastIs) {
  using enum nav::Certainty;
  EXPECT_EQ(depth_text({nav::DepthTo::kEntry, 123, kSure}), "12.3 mm to entry");
  EXPECT_EQ(depth_text({nav::DepthTo::kTarget, 0, kSure}), "0.0 mm to target");
  EXPECT_EQ(depth_text({nav::DepthTo::kTarget, 287, kBound}), "≥ 28.7 mm to target");
  EXPECT_EQ(depth_text({nav::DepthTo::kPastTarget, 12, kBound}), "≤ 1.2 mm past target");
  EXPECT_EQ(depth_text({nav::DepthTo::kTarget, 310, kUnknown}), "31.0 mm? to target");
}

TEST(NumbersWording, SaysASizeOrItsBound) {
  using enum nav::Certainty;
  const auto texts = [](const nav::ShownSize& size) {
    std::string angle;
    append_angle(angle, size);
    std::string offset;
    append_offset(offset, size);
    return angle + ", " + offset;
  };
  EXPECT_EQ(texts({12, kSure}), "1.2°, tip 1.2 mm");
  EXPECT_EQ(texts({26, kBound}), "≤ 2.6°, tip ≤ 2.6 mm");
  EXPECT_EQ(texts({12, kUnknown}), "1.2°?, tip 1.2 mm?");
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

TEST(NumbersWording, SaysHowTheDrillGoes) {
  using enum nav::DrillAlarm;
  const auto text = [](nav::DrillAlarm alarm, bool watched) {
    std::string out;
    append_drill(out, {nav::DrillPhase::kDrilling, alarm, watched});
    return out;
  };
  EXPECT_EQ(text(kNone, true), "drilling");
  EXPECT_EQ(text(kRed, false), "drilling, tool not seen");
  EXPECT_EQ(text(kStop, true), "stop");
  EXPECT_EQ(text(kStop, false), "stop, tool not seen");
}

}  // namespace
}  // namespace orthonav::engine::numbers_wording_test
