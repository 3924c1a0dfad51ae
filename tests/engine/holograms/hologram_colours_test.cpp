#include "engine/holograms/shapes/hologram_colours.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

#include "base/srgb.h"
#include "engine/holograms/shapes/hologram_shapes.h"
#include "tests/support/colours_in_use.h"

namespace orthonav::engine {
namespace {

using render::Colour;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

/// How somebody without one kind of cones sees a colour: Machado, Oliveira and Fernandes, "A
/// Physiologically-based Model for Simulation of Color Vision Deficiency", 2009, severity 1.0, on
/// linear light.
struct Vision {
  const char* name;
  double from[3][3];
};
constexpr Vision kVisions[] = {
    {"protanopia",
     {{0.152286, 1.052583, -0.204868},
      {0.114503, 0.786281, 0.099216},
      {-0.003882, -0.048116, 1.051998}}},
    {"deuteranopia",
     {{0.367322, 0.860646, -0.227968},
      {0.280085, 0.672501, 0.047413},
      {-0.011820, 0.042940, 0.968881}}},
    {"tritanopia",
     {{1.255528, -0.076749, -0.178779},
      {-0.078411, 0.930809, 0.147602},
      {0.004733, 0.691367, 0.303900}}},
};

Colour seen(const Vision& vision, const Colour& c) {
  const auto row = [&](int i) {
    const double light =
        vision.from[i][0] * c.r + vision.from[i][1] * c.g + vision.from[i][2] * c.b;
    return static_cast<float>(std::clamp(light, 0.0, 1.0));
  };
  return {row(0), row(1), row(2), 1};
}

/// The smallest difference of two that mean different things.
double least_apart(const HologramColours& colours, const Vision& vision) {
  double least = 1000;
  for (const ColoursApart& pair : colours_apart()) {
    least = std::min(least, colour_difference(seen(vision, colours.*pair.first),
                                              seen(vision, colours.*pair.second)));
  }
  return least;
}

TEST(ColourDifference, IsThatOfTheCie) {
  EXPECT_NEAR(colour_difference({1, 0, 0, 1}, {0, 1, 0, 1}), 170.6, 0.1) << "sRGB's red and green";
  EXPECT_NEAR(colour_difference({0, 0, 0, 1}, {1, 1, 1, 1}), 100.0, 0.01);
}

TEST(HologramColours, OfTheColourBlindAreToldApartWithConesMissing) {
  ASSERT_TRUE(colour_blind_colours().check());
  for (const Vision& vision : kVisions) {
    EXPECT_GT(least_apart(colour_blind_colours(), vision), 25) << vision.name;
  }
  EXPECT_LT(least_apart({}, kVisions[0]), 20) << "which is why there are others";
}

std::string hex_of(const Colour& c) {
  const auto byte = [](float light) {
    return static_cast<unsigned>(std::lround(255 * srgb_from_linear(light)));
  };
  char text[16];
  std::snprintf(text, sizeof text, "#%02X%02X%02X", byte(c.r), byte(c.g), byte(c.b));
  return text;
}

TEST(HologramColours, AreThoseOfTheirPage) {
  std::ifstream file(std::string(ORTHONAV_SOURCE_DIR) + "/docs/holograms.md");
  const std::string page(std::istreambuf_iterator<char>(file), {});
  for (const NamedColour& each : kNamedColours) {
    EXPECT_THAT(page, ContainsRegex("\\| `" + std::string(each.name) + "` \\| [^|]+ \\| " +
                                    hex_of(HologramColours{}.*each.colour) + " \\| " +
                                    hex_of(colour_blind_colours().*each.colour) + " \\|"));
  }
}

TEST(HologramColours, AreReadAsAListOfChanges) {
  const auto none = read_colours("standard");
  ASSERT_TRUE(none) << none.error().message;
  EXPECT_EQ(*none, HologramColours{});
  EXPECT_EQ(*read_colours("colour-blind"), colour_blind_colours());

  const auto changed = read_colours("bone=#ffFFff,good=#40C4FF");
  ASSERT_TRUE(changed) << changed.error().message;
  EXPECT_EQ(changed->bone, (Colour{1, 1, 1, HologramColours{}.bone.a})) << "as opaque as before";
  EXPECT_NEAR(changed->good.g, 0.552f, 0.001f) << "sRGB becomes linear light";
  EXPECT_EQ(changed->poor, HologramColours{}.poor);

  const auto others = read_colours("colour-blind, rod=#FFFFFF");
  ASSERT_TRUE(others) << others.error().message;
  EXPECT_EQ(others->good, colour_blind_colours().good);
  EXPECT_EQ(others->rod, (Colour{1, 1, 1, 1}));
}

TEST(HologramColours, AreRefusedWhereTheyWouldMislead) {
  const auto refusal = [](const char* text) {
    const auto read = read_colours(text);
    return read ? "taken" : read.error().message;
  };
  EXPECT_THAT(refusal("good=#FFA010"), HasSubstr("good and fair are too much alike"));
  EXPECT_THAT(refusal("poor=#600000"), HasSubstr("poor has 0.02 of white's luminance"));
  EXPECT_THAT(refusal("green=#40C4FF"), HasSubstr("'green' is none of the colours recording, "));
  EXPECT_THAT(refusal("good=blue"), HasSubstr("good must be a colour like #40C4FF"));
  EXPECT_THAT(refusal("good=#40C4F"), HasSubstr("good must be"));
  EXPECT_THAT(refusal("good=#40C4FG"), HasSubstr("good must be"));
  EXPECT_THAT(refusal("good"), HasSubstr("good must be"));
  EXPECT_THAT(refusal(""), HasSubstr("'' is none"));
  EXPECT_THAT(refusal("good=#40C4FF,"), HasSubstr("'' is none"));
  EXPECT_THAT(refusal("good=#40C4FF,standard"), HasSubstr("'standard' is none"));
}

TEST(HologramColours, AreThoseOfEveryHologram) {
  const test::ColoursInUse in_use(colour_blind_colours());
  const HologramColours& colours = colour_blind_colours();
  EXPECT_EQ(colour_of(Grade::kPoor), colours.poor);
  render::Scene scene;
  const render::Float3 stroke[] = {{0, 0, 0}, {0.01f, 0, 0}};
  add_sampled_path(scene, stroke, PathState::kRecording, 101);
  add_sampled_path(scene, stroke, PathState::kSaved, 102);
  ASSERT_EQ(scene.lines.size(), 2u);
  EXPECT_EQ(scene.lines[0].colour, colours.recording);
  EXPECT_EQ(scene.lines[1].colour, colours.saved);
}

}  // namespace
}  // namespace orthonav::engine
