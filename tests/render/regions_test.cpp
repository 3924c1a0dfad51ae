#include <gtest/gtest.h>

#include <cmath>

#include "render/float3.h"
#include "render/frame/frame_items.h"
#include "render/shapes.h"
#include "tests/render/test_renderer.h"
#include "tests/render/test_scenes.h"

namespace orthonav::render {
namespace {

constexpr PixelSize kSize = {400, 240};

/// A point that hops about the room, the same at every run.
Float3 hop(int i) {
  const auto f = static_cast<float>(i);
  return {0.7f * std::sin(1.7f * f), 0.5f * std::sin(2.9f * f + 1),
          -0.9f + 0.8f * std::sin(4.3f * f)};
}

bool holds(const PixelRect& rect, int x_px, int y_px) {
  return x_px >= rect.left && x_px < rect.right && y_px >= rect.top && y_px < rect.bottom;
}

TEST(Regions, ShareNoPixelAndHoldEveryRectangle) {
  for (int round = 0; round < 20; ++round) {
    std::vector<PixelRect> regions;
    std::vector<PixelRect> rects;
    for (int i = 0; i < 25; ++i) {
      const Float3 p = hop(25 * round + i);
      const int left = 200 + static_cast<int>(1300 * p.x);
      const int top = 200 + static_cast<int>(1300 * p.y);
      rects.push_back({left, top, left + 5 + 7 * (i % 5), top + 5 + 11 * (i % 3)});
      add_region(regions, rects.back());
    }
    EXPECT_LE(regions.size(), 6u);
    for (std::size_t a = 0; a < regions.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        EXPECT_FALSE(touch(regions[a], regions[b]));
      }
    }
    for (const PixelRect& rect : rects) {
      int holding = 0;
      for (const PixelRect& region : regions) {
        holding += joined(region, rect) == region;
      }
      EXPECT_EQ(holding, 1);
    }
  }
}

TEST(Regions, KeepApartWhatIsFarApart) {
  std::vector<PixelRect> regions;
  add_region(regions, {0, 0, 100, 100});
  add_region(regions, {1000, 600, 1100, 700});
  EXPECT_EQ(regions.size(), 2u);
  add_region(regions, {110, 0, 210, 100});
  EXPECT_EQ(regions.size(), 2u) << "near neighbours are cheaper drawn as one";
  add_region(regions, {50, 50, 1050, 650});
  EXPECT_EQ(regions, (std::vector<PixelRect>{{0, 0, 1100, 700}}));
}

TEST(ScreenBounds, HoldWhatIsDrawnWhereverItIs) {
  TestRenderer renderer(kSize.width_px, kSize.height_px);
  int cut = 0;
  int small = 0;
  for (int i = 0; i < 60; ++i) {
    // Some reach through the near plane, some lie behind the eye, some beside the view.
    Float3 at = hop(i);
    if (i % 10 == 0) {
      at.z = -0.03f;
    }
    Scene scene = sphere_scene(MeshStyle::kRim, {}, at, 201);
    scene.lines = line_scene(0.03f, at, hop(i + 7)).lines;
    const View view = TestRenderer::straight_ahead();
    ScreenBounds sphere({&view, 1}, kSize.width_px, kSize.height_px);
    sphere.add_box(placed_at(at), box_of(*scene.meshes[0].mesh));
    ScreenBounds line({&view, 1}, kSize.width_px, kSize.height_px);
    line.add_disc(at, 0.015f);
    line.add_disc(hop(i + 7), 0.015f);
    // Over all the view, so that the line is not cut by its own region.
    scene.triangles.push_back({501, {Float3{-9, -9, -5}, {9, -9, -5}, {0, 9, -5}}, {}});
    for (const Float3 p : scene.meshes[0].mesh->positions) {
      const auto seen = project(view, at + p, kSize.width_px, kSize.height_px);
      if (!seen) {
        continue;
      }
      const int x_px = static_cast<int>(std::floor(seen->x_px));
      const int y_px = static_cast<int>(std::floor(seen->y_px));
      if (!holds({0, 0, kSize.width_px, kSize.height_px}, x_px, y_px)) {
        continue;
      }
      EXPECT_TRUE(holds(sphere.rect(), x_px, y_px)) << i;
    }
    const LabelImage labels = renderer.labels(scene, view);
    for (int y = 0; y < kSize.height_px; ++y) {
      for (int x = 0; x < kSize.width_px; ++x) {
        const Label label = labels.labels[static_cast<std::size_t>(y) * kSize.width_px + x];
        ASSERT_TRUE(label != 401 || holds(line.rect(), x, y)) << i;
      }
    }
    cut += sphere.rect().area() == kSize.width_px * kSize.height_px;
    small += sphere.rect().area() < kSize.width_px * kSize.height_px / 4;
  }
  EXPECT_GT(cut, 0);
  EXPECT_GT(small, 30) << "the twin: mostly they are no more than what is needed";
}

/// The brighter of two images, pixel by pixel.
RgbaImage brighter(const RgbaImage& a, const RgbaImage& b) {
  RgbaImage out = a;
  for (std::size_t i = 0; i < out.pixels.size(); ++i) {
    out.pixels[i] = std::max(a.pixels[i], b.pixels[i]);
  }
  return out;
}

TEST(Regions, DrawnTogetherAreAsDrawnAlone) {
  TestRenderer renderer(640, 400);
  const View view = TestRenderer::straight_ahead();
  const Scene left = sphere_scene(MeshStyle::kSolid, {1, 0.5f, 0, 1}, {-0.4f, 0.2f, -1}, 301);
  Scene right = crowded_scene();
  for (MeshItem& item : right.meshes) {
    item.world_from_model[3].x += 0.35f;
  }
  right.lines.clear();
  right.triangles.clear();
  for (TextItem& text : right.texts) {
    text.position.x += 0.35f;
  }
  Scene both = left;
  for (const MeshItem& item : right.meshes) {
    both.meshes.push_back(item);
  }
  both.texts = right.texts;
  const RgbaImage alone = renderer.draw(left, view);
  const RgbaImage others = renderer.draw(right, view);
  EXPECT_EQ(renderer.draw(both, view), brighter(alone, others));
  EXPECT_NE(others, brighter(alone, others)) << "the twin";
}

TEST(Regions, SideBySideAreCopiedInTurn) {
  TestRenderer renderer(640, 400);
  const View view = TestRenderer::straight_ahead();
  Scene scene = sphere_scene(MeshStyle::kSolid, {1, 0.5f, 0, 1}, {-0.4f, 0, -1}, 301);
  const Scene other = sphere_scene(MeshStyle::kSolid, {1, 0.5f, 0, 1}, {0.4f, 0.02f, -1}, 302);
  scene.meshes.push_back(other.meshes[0]);
  const LabelImage labels = renderer.labels(scene, view);  // validated, synchronization included
  ASSERT_TRUE(extent_of(labels, 301) && extent_of(labels, 302));
  EXPECT_NEAR(static_cast<double>(extent_of(labels, 301)->pixels),
              static_cast<double>(extent_of(labels, 302)->pixels), 40.0);
}

TEST(Regions, KeepTheirBackgroundAndTheRestItsOwn) {
  TestRenderer renderer(640, 400, Blend::kOver);
  RgbaImage background{640, 400, std::vector<std::uint8_t>(4ul * 640 * 400)};
  for (std::size_t i = 0; i < background.pixels.size(); ++i) {
    background.pixels[i] = static_cast<std::uint8_t>(i % 4 == 3 ? 255 : i * 7 % 251);
  }
  const View view = TestRenderer::straight_ahead();
  Scene scene = sphere_scene(MeshStyle::kSolid, {1, 1, 1, 1}, {-0.4f, 0.2f, -1}, 301);
  const RgbaImage image = renderer.draw(scene, view, &background);
  const LabelImage labels = renderer.labels(scene, view);
  std::size_t changed = 0;
  for (int y = 0; y < 400; ++y) {
    for (int x = 0; x < 640; ++x) {
      const bool same = pixel(image, x, y) == pixel(background, x, y);
      changed += !same;
      // The outline's own pixels are partly covered.
      const bool near = std::abs(x - 64) < 40 && std::abs(y - 67) < 40;
      ASSERT_TRUE(same || near) << x << ' ' << y;
    }
  }
  EXPECT_GT(changed, 1000u);
  EXPECT_TRUE(extent_of(labels, 301));
}

}  // namespace
}  // namespace orthonav::render
