#include <gtest/gtest.h>

#include <algorithm>

#include "engine/holograms/labels/status_rows.h"
#include "engine/session/steps/guiding.h"
#include "engine/session/text/wording.h"
#include "tests/support/language_in_use.h"
#include "tools/orthonav/language/language_file.h"

namespace orthonav::engine::language_widths_test {
namespace {

/// Everything is written in German for a wearer.
class German : public ::testing::Test {
 protected:
  test::LanguageInUse german_{tools::language_named("de").value()};
  WearersLanguage language_;
};

TEST_F(German, WordsBesideTheNumbersHaveThePlaceOfTheEnglishOnes) {
  for (const char* word : {words::kClearance, words::kAtLeast, words::kTip, words::kAims}) {
    EXPECT_NE(translated(word), word);
    EXPECT_LE(width_caps(translated(word)), width_caps(words::kClearance)) << translated(word);
  }
  for (const char* word : {"cranial", "caudal", "medial", "lateral"}) {
    EXPECT_LE(width_caps(translated(word)), 1.1f * width_caps(word)) << translated(word);
  }
  std::string breach;
  append_breach(breach, {4, -1, "posterior"});
  EXPECT_LE(width_caps(breach), width_caps("may break through posteriorly")) << breach;
}

TEST_F(German, RowsThatAreNotBrokenFitTheDisplay) {
  EXPECT_LE(width_caps(translated(words::kHeadNotLocated)), kStatusWidth_caps);
  std::string stop;
  append_drill(stop, {nav::DrillPhase::kDrilling, nav::DrillAlarm::kStop, false});
  EXPECT_LE(width_caps(stop), kStatusWidth_caps) << stop;
}

TEST_F(German, PartsThatAreNeverDroppedFitARow) {
  for (std::size_t part = 0; part < kPartCount; ++part) {
    StatusLine line;
    line.stalled = static_cast<Part>(part);
    EXPECT_LE(width_caps(detail_text(line)), kStatusWidth_caps) << detail_text(line);
  }
}

}  // namespace
}  // namespace orthonav::engine::language_widths_test
