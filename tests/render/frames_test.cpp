#include <gmock/gmock.h>

#include <algorithm>

#include "render/shapes.h"
#include "tests/render/test_renderer.h"
#include "tests/render/test_scenes.h"

namespace orthonav::render {
namespace {

using ::testing::ElementsAre;

constexpr std::array<int, 3> kBlack = {0, 0, 0};

TEST(Order, OfSubmissionNeverChangesAFrame) {
  for (const Blend blend : {Blend::kAdditive, Blend::kOver}) {
    TestRenderer renderer(200, 120, blend);
    Scene scene = crowded_scene();
    const RgbaImage image = renderer.draw(scene, TestRenderer::straight_ahead());
    const LabelImage labels = renderer.labels(scene, TestRenderer::straight_ahead());
    std::reverse(scene.meshes.begin(), scene.meshes.end());
    std::reverse(scene.lines.begin(), scene.lines.end());
    std::reverse(scene.triangles.begin(), scene.triangles.end());
    std::rotate(scene.texts.begin(), scene.texts.begin() + 1, scene.texts.end());
    EXPECT_EQ(renderer.draw(scene, TestRenderer::straight_ahead()), image);
    EXPECT_EQ(renderer.labels(scene, TestRenderer::straight_ahead()), labels);
    scene.texts.pop_back();
    EXPECT_NE(renderer.draw(scene, TestRenderer::straight_ahead()), image) << "the twin";
  }
}

/// Two meshes at one place, whose tints alone tell them apart: the item's, or the vertices'.
TEST(Order, OfMeshesThatDifferInTintsAloneNeverChangesAFrame) {
  auto tinted = make_sphere(0.1f);
  tinted.tints.assign(tinted.positions.size(), 1.0f);
  auto untinted = tinted;
  untinted.tints.assign(tinted.positions.size(), 0.0f);
  MeshItem item;
  item.label = 1;
  item.world_from_model[3].z = -1;
  item.mesh = std::make_shared<const MeshData>(tinted);
  item.tint = {1, 0, 0, 1};
  MeshItem other_tint = item;
  other_tint.tint = {0, 0, 1, 1};
  MeshItem other_mesh = item;
  other_mesh.mesh = std::make_shared<const MeshData>(untinted);
  for (const MeshItem& other : {other_tint, other_mesh}) {
    for (const float opacity : {1.0f, 0.5f}) {
      std::array items = {item, other};
      for (MeshItem& each : items) {
        each.colour.a = each.tint.a = opacity;
      }
      TestRenderer renderer(64, 64, Blend::kOver);
      const auto drawn = [&](const MeshItem& first, const MeshItem& second) {
        Scene scene;
        scene.meshes.push_back(first);
        scene.meshes.push_back(second);
        return renderer.draw(scene, TestRenderer::straight_ahead());
      };
      EXPECT_EQ(drawn(items[0], items[1]), drawn(items[1], items[0])) << opacity;
      EXPECT_NE(drawn(items[0], items[0]), drawn(items[1], items[1])) << "the twin";
    }
  }
}

TEST(Frames, RepeatToTheBit) {
  TestRenderer renderer;
  const RgbaImage first = renderer.draw(crowded_scene(), TestRenderer::straight_ahead());
  TestRenderer other;
  EXPECT_EQ(renderer.draw(crowded_scene(), TestRenderer::straight_ahead()), first);
  EXPECT_EQ(other.draw(crowded_scene(), TestRenderer::straight_ahead()), first);
}

TEST(Frames, OfOneSampleShowTheSameThings) {
  TestRenderer renderer(200, 120, Blend::kAdditive, Edges::kHard);
  const RgbaImage image = renderer.draw(line_scene(0.03f, {-0.4f, 0, -1}, {0.4f, 0, -1}),
                                        TestRenderer::straight_ahead());
  EXPECT_THAT(pixel(image, 100, 60), ElementsAre(255, 255, 255));
  EXPECT_EQ(pixel(image, 100, 20), kBlack);
}

TEST(Labels, HaveTheirExactValuesAndNothingBetween) {
  TestRenderer renderer;
  Scene scene = crowded_scene();
  scene.triangles[0].label = 0xfffffffe;
  const LabelImage labels = renderer.labels(scene, TestRenderer::straight_ahead());
  for (const Label label : labels.labels) {
    const bool known = label == 0 || (label >= 201 && label <= 202) || label == 301 ||
                       label == 302 || label == 401 || label == 402 || label == 502 ||
                       label == 503 || (label >= 601 && label <= 603) || label == 0xfffffffe;
    EXPECT_TRUE(known) << label;
  }
  EXPECT_TRUE(extent_of(labels, 0xfffffffe));
}

}  // namespace
}  // namespace orthonav::render
