#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/golden/golden_fixture.h"
#include "tests/golden/golden_image_edit.h"
#include "tests/golden/golden_scene_edit.h"

namespace orthonav::engine {
namespace {

using render::Label;

/// How many of the spoilt pictures the comparison noticed, and how many there were.
struct Caught {
  int all = 0;
  int noticed = 0;
  /// A picture counts when labels (where they must differ) and both kinds of colour differ.
  void count(const GoldenImages& good, const GoldenImages& spoilt, bool labels_differ = true) {
    ++all;
    if (render::compare_labels(good.labels, spoilt.labels).alike() != labels_differ &&
        !render::compare_colour(good.additive, spoilt.additive).alike() &&
        !render::compare_colour(good.over, spoilt.over).alike()) {
      ++noticed;
    }
  }
};

/// Scenes whose spoilt pictures are drawn too: a picture for every hologram and number of a scene.
class GoldenControls : public Golden {};

TEST_P(GoldenControls, AreAllNoticed) {
  const GoldenImages good = painted(golden_);
  Caught hidden;
  Caught shifted;
  Caught dim;
  Caught digit;
  Caught mirror;
  Caught swapped;
  for (const Label label : labels_in(golden_.scene)) {
    hidden.count(good, spoilt(without(golden_, label)));
    shifted.count(good, spoilt(moved(golden_, label, {1, 0})));
    dim.count(good, spoilt(dimmed(golden_, label)), false);
  }
  for (const GoldenScene& other : with_one_number_changed(golden_)) {
    digit.count(good, spoilt(other));
  }
  const auto views = static_cast<int>(golden_.views.size());
  mirror.count(good, mirrored(good, views));
  if (views == 2) {
    swapped.count(good, eyes_swapped(good));
  }
  EXPECT_GT(hidden.all, 0) << "a scene without holograms";
  for (const auto& [what, caught] : {std::pair("hidden", hidden),
                                     {"moved by a pixel", shifted},
                                     {"dimmed", dim},
                                     {"a digit changed", digit},
                                     {"mirrored", mirror},
                                     {"eyes swapped", swapped}}) {
    EXPECT_EQ(caught.noticed, caught.all) << what;
  }
}

/// All scenes, but of guidance from nine places (three distances × three rolls) only three, so that
/// each distance and each roll occurs once.
std::vector<std::string> scenes_with_controls() {
  const std::set<std::string> elsewhere = {
      "guidance_35cm_rolled_left", "guidance_35cm_rolled_right", "guidance_50cm_rolled_left",
      "guidance_50cm_upright",     "guidance_70cm_upright",      "guidance_70cm_rolled_right"};
  std::vector<std::string> names = scene_names();
  EXPECT_EQ(std::erase_if(names, [&](const auto& name) { return elsewhere.contains(name); }),
            elsewhere.size());
  return names;
}

INSTANTIATE_TEST_SUITE_P(Scenes, GoldenControls, ::testing::ValuesIn(scenes_with_controls()),
                         [](const auto& param) { return param.param; });

}  // namespace
}  // namespace orthonav::engine
