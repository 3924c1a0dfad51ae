#include "tools/orthonav/igtl/igtl_messages.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <map>
#include <string>
#include <vector>

namespace orthonav::tools::igtl_test {
namespace {

using Bytes = std::vector<std::uint8_t>;
/// Bodies by type and device.
using Messages = std::map<std::string, Bytes>;

constexpr float kFloat_mm = 1e-3F;

igtl::Header header_at(const Bytes& bytes, std::size_t at) {
  return igtl::parsed_header(std::span<const std::uint8_t, igtl::kHeaderBytes>(bytes.data() + at,
                                                                               igtl::kHeaderBytes))
      .value();
}

Messages messages_in(const Bytes& bytes) {
  Messages out;
  for (std::size_t at = 0; at < bytes.size();) {
    const igtl::Header header = header_at(bytes, at);
    const auto body = bytes.begin() + static_cast<std::ptrdiff_t>(at + igtl::kHeaderBytes);
    out[header.type + " " + header.device] = {
        body, body + static_cast<std::ptrdiff_t>(header.body_bytes)};
    at += igtl::kHeaderBytes + static_cast<std::size_t>(header.body_bytes);
  }
  return out;
}

float float_at(const Bytes& body, std::size_t at) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    bits = bits << 8u | body.at(at + i);
  }
  float value = 0.0F;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// A TRANSFORM's body applied to a point, mm.
std::array<float, 3> moved(const Bytes& transform, std::array<float, 3> p) {
  std::array<float, 3> out{};
  for (std::size_t row = 0; row < 3; ++row) {
    out[row] = float_at(transform, 4 * (9 + row));
    for (std::size_t column = 0; column < 3; ++column) {
      out[row] += float_at(transform, 4 * (3 * column + row)) * p[column];
    }
  }
  return out;
}

engine::LevelState level_l4() {
  engine::LevelState level;
  level.plan.label = "L4";
  level.plan.screws = {{nav::Side::kLeft, {{0.02, 0.03, 0.004}}, {{0.01, -0.01, 0.005}}, 0.003}};
  return level;
}

TEST(IgtlMessages, NamesDevicesWithinTwentyBytesAndWithOneTo) {
  EXPECT_EQ(igtl_device("pointer", "Reference"), "PointerToReference");
  EXPECT_EQ(igtl_device("drill guide 2", "World"), "Drillguide2ToWorld");
  EXPECT_EQ(igtl_device("screwdriver", "Reference"), "ScrewdrivToReference");
  EXPECT_EQ(igtl_device("ToTo", "World"), "TotoToWorld");
}

TEST(IgtlMessages, GiveNoTwoToolsOneName) {
  std::vector<nav::ToolGeometry> tools(3);
  tools[0].name = "screwdriver long";
  tools[1].name = "screwdriver short";
  tools[2].name = "pointer";
  EXPECT_FALSE(igtl_name_is_taken(tools, 0, "Reference"));
  EXPECT_TRUE(igtl_name_is_taken(tools, 1, "Reference")) << "both ScrewdrivToReference";
  EXPECT_FALSE(igtl_name_is_taken(tools, 2, "Reference"));
  EXPECT_FALSE(igtl_name_is_taken(tools, 1, "World"))
      << "ScrewdriverloToWorld and ScrewdrivershToWorld";
}

TEST(IgtlMessages, PutAModelInRasWhereTheRegistrationHasTheBone) {
  engine::LevelState level = level_l4();
  nav::Registration registration;
  registration.world_from_vertebra = {rotation_from_vector({0.1, 0.5, -0.3}), {0.1, -0.2, 0.3}};
  level.registration = registration;
  engine::Guidance guidance;
  guidance.levels = {&level, 1};
  EXPECT_TRUE(igtl_models(guidance).empty()) << "not accepted";
  level.accepted = true;
  const Messages world = messages_in(igtl_models(guidance));
  ASSERT_TRUE(world.contains("TRANSFORM L4ModelToWorld"));
  // The screw's entry: LPS in the plan, RAS in the model that 3D Slicer holds.
  const Vec3 want = 1e3 * (registration.world_from_vertebra * level.plan.screws[0].entry).v;
  const auto got = moved(world.at("TRANSFORM L4ModelToWorld"), {-20.0F, -30.0F, 4.0F});
  EXPECT_NEAR(got[0], want.x, kFloat_mm);
  EXPECT_NEAR(got[1], want.y, kFloat_mm);
  EXPECT_NEAR(got[2], want.z, kFloat_mm);

  nav::Anchor anchor;
  anchor.places = {{2, {rotation_from_vector({0, 0.2, 0}), {0.05, 0, 0}}}};
  guidance.anchor = &anchor;
  const Messages reference = messages_in(igtl_models(guidance));
  ASSERT_TRUE(reference.contains("TRANSFORM L4ModelToReference"));
  const Vec3 seen = (anchor.places[0].anchored_from_marker.inverse() * Point<World>{want * 1e-3}).v;
  EXPECT_NEAR(moved(reference.at("TRANSFORM L4ModelToReference"), {-20.0F, -30.0F, 4.0F})[0],
              1e3 * seen.x, kFloat_mm);
  level.unverified = true;
  EXPECT_TRUE(igtl_models(guidance).empty()) << "restored, and not verified since";
}

TEST(IgtlMessages, TellScrewsAsPointsAndAsACylinder) {
  const engine::LevelState level = level_l4();
  const Messages screws = messages_in(igtl_screws({&level, 1}, {}));
  ASSERT_TRUE(screws.contains("POINT L4leftScrew"));
  const Bytes& points = screws.at("POINT L4leftScrew");
  ASSERT_EQ(points.size(), 2u * 136u);
  EXPECT_EQ(float_at(points, 100), -20.0F);
  EXPECT_EQ(float_at(points, 104), -30.0F);
  EXPECT_EQ(float_at(points, 108), 4.0F);
  EXPECT_EQ(float_at(points, 112), 3.0F) << "radius";
  EXPECT_EQ(float_at(points, 136 + 104), 10.0F) << "the target";
  ASSERT_TRUE(screws.contains("POLYDATA L4leftScrewModel"));
}

}  // namespace
}  // namespace orthonav::tools::igtl_test
