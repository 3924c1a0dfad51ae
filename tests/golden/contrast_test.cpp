#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "base/printed.h"
#include "base/srgb.h"
#include "engine/case/operation_plan.h"
#include "engine/case/tool_file.h"
#include "engine/golden/golden_texts.h"
#include "engine/holograms/optical_model.h"
#include "engine/holograms/shapes/hologram_shapes.h"
#include "engine/holograms/shapes/hologram_status.h"
#include "engine/phantom/phantom.h"
#include "render/renderer.h"
#include "study/sim_scenario.h"
#include "tests/support/camera_scene.h"
#include "tests/support/is_ok.h"
#include "tests/support/test_device.h"

namespace orthonav::engine {
namespace {

// WCAG 2.2, 1.4.3: text is legible from this contrast on.
constexpr double kLegibleText = 4.5;
// A HoloLens 2's picture for one eye, and its field of view.
constexpr int kWidth_px = 1440;
constexpr int kHeight_px = 936;
constexpr float kTanAcross = 0.394f;
constexpr float kTanDown = 0.2561f;

double luminance(const RgbaImage& image, std::size_t pixel) {
  constexpr std::array<double, 3> kWeights = {0.2126, 0.7152, 0.0722};
  static const auto kLinear = [] {
    std::array<double, 256> linear{};
    for (std::size_t i = 0; i < linear.size(); ++i) {
      linear[i] = linear_from_srgb(static_cast<double>(i) / 255.0);
    }
    return linear;
  }();
  double sum = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    sum += kWeights[c] * kLinear[image.pixels[4 * pixel + c]];
  }
  return sum;
}

struct Background {
  const char* name;
  RgbaImage world;
  RgbaImage picture;  ///< the same behind the combiner
};

/// A few millimetres of what the surgeon sees there, filling the picture.
RgbaImage patch(sim::RoomRenderer& room, const sim::RoomState& state, Vec3 target) {
  const auto eye = sim::scene::looking(state.room_from_rig.translation(), target);
  const double across = 0.006 / (eye.translation() - target).norm();
  const sim::PinholeView view{{eye.rotation(), eye.translation()},
                              across,
                              across,
                              across * kHeight_px / kWidth_px,
                              across * kHeight_px / kWidth_px};
  RgbaImage picture;
  picture.width_px = kWidth_px;
  picture.height_px = kHeight_px;
  room.picture(state, view, picture);
  return picture;
}

std::vector<Background> backgrounds() {
  const auto operation = plan_operation(phantom({"L4"}), {"L4"});
  const sim::RoomDescription room = room_of(phantom(), *operation, built_in_tools());
  sim::RoomState state = sim::scene::operating_state(room);
  const auto renderer = sim::RoomRenderer::create(room, sim::ErrorModel::perfect());
  const Vec3 hand = state.hand->v;
  std::vector<Background> found;
  const auto add = [&](const char* name, const RgbaImage& world) {
    found.push_back({name, world, world});
    WorldBehindCombiner().dim(found.back().picture);
  };
  add("hand", patch(*renderer, state, hand + Vec3{0.012, 0.02, 0.0}));
  state.hand.reset();
  state.tool_present.assign(state.tool_present.size(), false);
  const auto& level = *std::find_if(room.levels.begin(), room.levels.end(),
                                    [](const sim::RoomLevel& l) { return l.label == "L4"; });
  // The hindmost of the bone: the tip of its spinous process, which the lamp lights most.
  const Vec3 tip = *std::max_element(level.vertices_m.begin(), level.vertices_m.end(),
                                     [](const Vec3& a, const Vec3& b) { return a.y < b.y; });
  const Vec3 bone = (state.room_from_spine * (level.spine_from_vertebra * Point<Vertebra>{tip})).v;
  add("bone", patch(*renderer, state, bone - Vec3{0, 0.001, 0}));
  add("wound", patch(*renderer, state, bone + Vec3{-0.024, -0.014, 0.012}));
  add("drape", patch(*renderer, state, bone + Vec3{0.02, 0.0, 0.20}));
  return found;
}

/// Draws texts on black and over backgrounds.
class Painter {
 public:
  explicit Painter(render::Blend blend) {
    render::RendererOptions options;
    options.width_px = kWidth_px;
    options.height_px = kHeight_px;
    options.blend = blend;
    options.device = test::test_device();
    options.cache_folder = "";
    auto made = render::Renderer::create(options);
    EXPECT_TRUE(test::is_ok(made));
    renderer_ = std::move(*made);
  }
  RgbaImage draw(const render::Scene& scene, const RgbaImage* background) {
    render::View view;
    view.tan_left = view.tan_right = kTanAcross;
    view.tan_up = view.tan_down = kTanDown;
    std::vector<const RgbaImage*> behind;
    if (background != nullptr) {
      behind.push_back(background);
    }
    std::vector<RgbaImage> images;
    EXPECT_TRUE(test::is_ok(renderer_->draw(scene, {view}, behind, images)));
    return images.front();
  }

 private:
  std::unique_ptr<render::Renderer> renderer_;
};

/// The text alone, in the middle of the view, half a metre away.
render::Scene in_view(const render::TextItem& text) {
  render::Scene scene;
  scene.texts.push_back(text);
  render::TextItem& item = scene.texts.back();
  item.place = render::TextPlace::kView;
  item.position = {0, 0, -0.5f};
  item.align = render::TextAlign::kCentre;
  item.offset_right = item.offset_up = 0;
  return scene;
}

/// Where a text lies: what shines nearly as bright as its brightest pixel, and its box.
struct Ink {
  std::vector<std::size_t> pixels;
  std::vector<std::size_t> box;
  double luminance = 0.0;  ///< of the pixels, on black
};

double mean_luminance(const RgbaImage& image, const std::vector<std::size_t>& pixels) {
  double sum = 0.0;
  for (const std::size_t i : pixels) {
    sum += luminance(image, i);
  }
  return sum / static_cast<double>(pixels.size());
}

Ink ink_of(const RgbaImage& light) {
  std::vector<double> seen(light.pixels.size() / 4);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    seen[i] = luminance(light, i);
  }
  const double least = 0.9 * *std::max_element(seen.begin(), seen.end());
  const auto width = static_cast<std::size_t>(light.width_px);
  std::array<std::size_t, 4> edges = {width, 0, seen.size(), 0};
  Ink ink;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (seen[i] >= least) {
      ink.pixels.push_back(i);
      edges = {std::min(edges[0], i % width), std::max(edges[1], i % width),
               std::min(edges[2], i / width), std::max(edges[3], i / width)};
    }
  }
  for (std::size_t y = edges[2]; y <= edges[3]; ++y) {
    for (std::size_t x = edges[0]; x <= edges[1]; ++x) {
      ink.box.push_back(y * width + x);
    }
  }
  EXPECT_GT(ink.pixels.size(), 20u);
  ink.luminance = mean_luminance(light, ink.pixels);
  return ink;
}

/// Brighter than nine tenths of what is behind the text.
double bright_luminance(const RgbaImage& image, const std::vector<std::size_t>& pixels) {
  std::vector<double> seen;
  for (const std::size_t i : pixels) {
    seen.push_back(luminance(image, i));
  }
  const auto at = seen.begin() + static_cast<std::ptrdiff_t>(seen.size() * 9 / 10);
  std::nth_element(seen.begin(), at, seen.end());
  return *at;
}

double ratio(double text, double behind) { return (text + 0.05) / (behind + 0.05); }

/// The contrast of a text: in a picture, or to the eye behind the combiner.
struct Contrasts {
  Painter additive{render::Blend::kAdditive};
  Painter over{render::Blend::kOver};

  /// The lowest contrast of headset, film and preview; `ink` is that of the scene on black.
  double least(const render::Scene& scene, const Ink& ink, const Background& behind) {
    const double in_pictures = bright_luminance(behind.picture, ink.box);
    const OpticalModel optics;
    const double to_the_eye =
        bright_luminance(behind.world, ink.box) * optics.white_sheet_cd_m2() / optics.display_cd_m2;
    return std::min(
        {ratio(ink.luminance + to_the_eye, to_the_eye),
         ratio(mean_luminance(additive.draw(scene, &behind.picture), ink.pixels), in_pictures),
         ratio(mean_luminance(over.draw(scene, &behind.picture), ink.pixels), in_pictures)});
  }
};

/// The row of legibility.md for a kind of text.
std::string contrast_row(const std::string& kind) {
  std::ifstream file(ORTHONAV_SOURCE_DIR "/tests/golden/legibility.md");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("| " + kind + " |")) {
      return line;
    }
  }
  return {};
}

/// The same words, and numbers that differ by no more than what rounding may do on another machine.
void expect_nearly(const std::string& kept, const std::string& measured) {
  std::istringstream docs(kept), now(measured);
  std::string a, b;
  while (now >> b) {
    docs >> a;
    char* end = nullptr;
    const double number = std::strtod(b.c_str(), &end);
    if (end != b.c_str() && *end == 0) {
      EXPECT_NEAR(std::strtod(a.c_str(), nullptr), number, 0.11)
          << "tests/golden/legibility.md is stale: " << kept << " is now " << measured;
    } else {
      EXPECT_EQ(a, b) << "tests/golden/legibility.md is stale: " << kept << " is now " << measured;
    }
    a.clear();
  }
}

TEST(Contrast, EveryTextIsLegibleOverEverythingInTheRoom) {
  const std::vector<Background> behind = backgrounds();
  Contrasts contrasts;
  for (const TextKind& kind : text_kinds()) {
    const render::Scene scene = in_view(kind.text);
    const Ink ink = ink_of(contrasts.additive.draw(scene, nullptr));
    std::string row = "| " + kind.name + " |";
    for (const Background& b : behind) {
      const double least = contrasts.least(scene, ink, b);
      EXPECT_GE(least, kLegibleText) << kind.name << " over " << b.name;
      row += printed(" %.1f |", least);
    }
    std::printf("%s\n", row.c_str());
    expect_nearly(contrast_row(kind.name), row);
  }
  // The control: red light alone is not legible.
  render::Scene red = in_view(text_kinds().front().text);
  for (render::TextRun& run : red.texts[0].runs) {
    run.colour = look::colours().poor;
  }
  const Ink ink = ink_of(contrasts.additive.draw(red, nullptr));
  for (const Background& b : behind) {
    EXPECT_LT(contrasts.least(red, ink, b), kLegibleText) << b.name;
  }
}

}  // namespace
}  // namespace orthonav::engine
