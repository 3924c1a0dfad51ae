// The layout of labels, judged by where their ink is in both eyes.
#include <gmock/gmock.h>

#include <functional>

#include "base/random.h"
#include "engine/holograms/hologram_label.h"
#include "engine/holograms/label_layout.h"
#include "tests/engine/holograms/operating_field.h"

namespace orthonav::engine {
namespace {

using test::OperatingField;
using ::testing::IsEmpty;

constexpr int kHeads = 400;

void lay_out(OperatingField& field, const std::vector<render::View>& views) {
  LabelLayout().lay_out(field.scene, views, field.papers, Timestamp{});
}

struct Crowd {
  const char* name;
  std::function<OperatingField()> make;
};

class CrowdedLabels : public ::testing::TestWithParam<Crowd> {};

TEST_P(CrowdedLabels, LeaveEachOtherAndWhatTheyNameClear) {
  Random random(7);
  std::size_t faults_before = 0;
  for (int i = 0; i < kHeads; ++i) {
    const auto views = test::any_head(random);
    OperatingField field = GetParam().make();
    faults_before += test::faults(field, views).size();
    lay_out(field, views);
    EXPECT_THAT(test::faults(field, views), IsEmpty()) << "head " << i;
  }
  EXPECT_GT(faults_before, 0u) << "there is nothing to lay out here";
}

TEST_P(CrowdedLabels, AreLeftOutOnlyWhereTheyAreIncidental) {
  Random random(8);
  for (int i = 0; i < kHeads; ++i) {
    OperatingField field = GetParam().make();
    const std::vector<test::Standing> before = test::standing(field.scene);
    std::vector<LabelRank> ranks;
    for (const render::TextItem& text : field.scene.texts) {
      ranks.push_back(rank_of(text));
    }
    lay_out(field, test::any_head(random));
    const std::vector<test::Standing> after = test::standing(field.scene);
    for (std::size_t k = 0; k < ranks.size(); ++k) {
      EXPECT_TRUE(after[k].shown || ranks[k] == LabelRank::kIncidental) << k;
      EXPECT_TRUE(after[k] == before[k] || ranks[k] != LabelRank::kFixed || k + 1 == ranks.size())
          << k;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Fields, CrowdedLabels,
    ::testing::Values(Crowd{"one_level", [] { return test::guided_levels(1, 0.1f); }},
                      Crowd{"two_levels", [] { return test::guided_levels(2, -0.2f); }},
                      Crowd{"three_levels", [] { return test::entry_points(3); }},
                      Crowd{"six_levels", [] { return test::guided_levels(6, 0.05f); }},
                      Crowd{"short_rods", [] { return test::rods(2); }},
                      Crowd{"long_rods", [] { return test::rods(6); }},
                      Crowd{"checks", [] { return test::checked_places(6); }}),
    [](const auto& param) { return param.param.name; });

}  // namespace
}  // namespace orthonav::engine
