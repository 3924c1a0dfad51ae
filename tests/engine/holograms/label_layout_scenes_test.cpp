// The layout of labels, judged by where their ink is in both eyes.
#include <gmock/gmock.h>

#include <algorithm>
#include <functional>

#include "base/random.h"
#include "engine/holograms/labels/label_layout.h"
#include "engine/holograms/labels/label_places.h"
#include "engine/holograms/shapes/hologram_label.h"
#include "render/frame/frame_items.h"
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
  std::size_t over_paper = 0;
  for (int i = 0; i < kHeads; ++i) {
    const auto views = test::any_head(random);
    OperatingField field = GetParam().make();
    faults_before += test::faults(field, views).size();
    lay_out(field, views);
    std::vector<std::string> faults = test::faults(field, views);
    over_paper += std::erase(faults, "◐ over paper");
    EXPECT_THAT(faults, IsEmpty()) << "head " << i;
  }
  // Beside the wounds of six levels the status line may find no other place than paper: the end of
  // it, at one head.
  EXPECT_LE(over_paper, 1u);
  EXPECT_GT(faults_before, 0u) << "there is nothing to lay out here";
}

TEST_P(CrowdedLabels, AreWholeOrLeftOut) {
  constexpr float kDigit = 0.006f;
  Random random(8);
  std::size_t cut_before = 0;
  std::size_t left_out = 0;
  std::size_t shown = 0;
  const render::Font font;
  for (int i = 0; i < kHeads; ++i) {
    OperatingField field = GetParam().make();
    const auto views = test::any_head(random);
    const Eyes eyes(views);
    const auto cut = [&](const render::TextItem& text) {
      LabelExtent extent;
      extent.width = render::line_width(font, text);
      return text.place == render::TextPlace::kWorld && !text.runs.empty() &&
             !eyes.in_view(grown(eyes.box(render::world_from_caps(text, eyes.head()),
                                          box_at(place_of(text, extent, 0), extent)),
                                 0.9f * kDigit));
    };
    cut_before += static_cast<std::size_t>(
        std::count_if(field.scene.texts.begin(), field.scene.texts.end(), cut));
    lay_out(field, views);
    for (const render::TextItem& text : field.scene.texts) {
      EXPECT_FALSE(cut(text)) << text.runs[0].text << ", head " << i;
      (text.runs.empty() ? left_out : shown) += 1;
    }
  }
  EXPECT_GT(cut_before, 0u) << "nothing would be cut here";
  EXPECT_GT(shown, 3 * left_out) << "most have room";
}

INSTANTIATE_TEST_SUITE_P(
    Fields, CrowdedLabels,
    ::testing::Values(Crowd{"three_levels", [] { return test::entry_points(3); }},
                      Crowd{"six_levels", [] { return test::guided_levels(6, 0.05f); }},
                      Crowd{"short_rods", [] { return test::rods(2); }},
                      Crowd{"long_rods", [] { return test::rods(6); }},
                      Crowd{"checks", [] { return test::checked_places(6); }}),
    [](const auto& param) { return param.param.name; });

}  // namespace
}  // namespace orthonav::engine
