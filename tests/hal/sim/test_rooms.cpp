#include "tests/hal/sim/test_rooms.h"

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <tuple>

#include "hal/sim/room/bone_surface.h"
#include "tests/support/test_data.h"

namespace orthonav::sim {
namespace {

constexpr double kMm = 0.001;

double bump(double angle_rad, double height_m, double width_rad) {
  return height_m * std::exp(-0.5 * std::pow(angle_rad / width_rad, 2));
}

double radius_m(Vec3 direction) {
  return 0.030 + bump(angle_between_rad(direction, {0, 1, 0}), 0.040, 0.22) +
         bump(angle_between_rad(direction, Vec3{1, 0.35, 0}.normalized()), 0.016, 0.25) +
         bump(angle_between_rad(direction, Vec3{-1, 0.35, 0}.normalized()), 0.016, 0.25);
}

RoomLevel read_stl(const std::string& path) {
  RoomLevel level;
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (bytes.size() < 84) {
    return level;
  }
  std::map<std::tuple<float, float, float>, std::uint32_t> known;
  for (std::size_t at = 84; at + 50 <= bytes.size(); at += 50) {
    std::array<float, 9> xyz{};
    std::memcpy(xyz.data(), bytes.data() + at + 12, sizeof(xyz));
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto key = std::make_tuple(xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]);
      const auto [found, fresh] =
          known.emplace(key, static_cast<std::uint32_t>(level.vertices_m.size()));
      if (fresh) {
        level.vertices_m.push_back(kMm * Vec3{xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]});
      }
      triangle[i] = found->second;
    }
    level.triangles.push_back(triangle);
  }
  return level;
}

Vec3 vector_from(const nlohmann::json& numbers) {
  return kMm * Vec3{numbers[0].get<double>(), numbers[1].get<double>(), numbers[2].get<double>()};
}

Transform<Spine, Vertebra> pose_from(const nlohmann::json& rows) {
  Mat3 rotation;
  for (int r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) {
      rotation[r][c] = rows[static_cast<std::size_t>(r)][c].get<double>();
    }
  }
  const auto at = [&rows](std::size_t r) { return kMm * rows[r][3].get<double>(); };
  return {orthonormalized(rotation), {at(0), at(1), at(2)}};
}

}  // namespace

std::vector<RoomTool> test_tools() {
  RoomTool pointer{"pointer", ToolKind::kPointer, "tag36h11", 3,
                   0.050,     {{0, -0.150, 0}},   {0, 1, 0}};
  RoomTool guide{"guide", ToolKind::kGuide, "tag36h11", 5, 0.070, {{0, -0.150, 0}}, {0, 1, 0}};
  return {pointer, guide};
}

RoomLevel synthetic_level(const std::string& label, double z_in_spine_m) {
  constexpr int kRings = 60;
  constexpr int kSlices = 90;
  RoomLevel level;
  level.label = label;
  level.spine_from_vertebra = {rotation_from_vector({0.1, 0.0, 0.0}), {0, 0, z_in_spine_m}};
  const auto vertex = [](double ring, double slice) {
    const double polar = std::numbers::pi * ring / kRings;
    const double angle_rad = 2.0 * std::numbers::pi * slice / kSlices;
    const Vec3 direction{std::sin(polar) * std::cos(angle_rad),
                         std::sin(polar) * std::sin(angle_rad), std::cos(polar)};
    return radius_m(direction) * direction;
  };
  level.vertices_m.push_back(vertex(0, 0));
  for (int ring = 1; ring < kRings; ++ring) {
    for (int slice = 0; slice < kSlices; ++slice) {
      level.vertices_m.push_back(vertex(ring, slice));
    }
  }
  level.vertices_m.push_back(vertex(kRings, 0));
  const auto index = [](int ring, int slice) {
    if (ring == 0) {
      return 0U;
    }
    if (ring == kRings) {
      return static_cast<std::uint32_t>(1 + (kRings - 1) * kSlices);
    }
    return static_cast<std::uint32_t>(1 + (ring - 1) * kSlices + slice % kSlices);
  };
  for (int ring = 0; ring < kRings; ++ring) {
    for (int slice = 0; slice < kSlices; ++slice) {
      if (ring > 0) {
        level.triangles.push_back(
            {index(ring, slice), index(ring + 1, slice), index(ring, slice + 1)});
      }
      if (ring < kRings - 1) {
        level.triangles.push_back(
            {index(ring, slice + 1), index(ring + 1, slice), index(ring + 1, slice + 1)});
      }
    }
  }
  return level;
}

/// What `FakeEngine` listens for.
const SurgeonPhrases kSaid{"begin guiding", "save points", "delete last", "accept result",
                           "reject level",  "go to next",  "finish rod"};

TestCase synthetic_case() {
  TestCase made;
  made.room.phrases = kSaid;
  made.room.tools = test_tools();
  made.room.levels = {synthetic_level("L4", 0.0), synthetic_level("L5", -0.045)};
  for (const RoomLevel& level : made.room.levels) {
    for (const double side : {1.0, -1.0}) {
      const Vec3 target{side * 0.006, -0.005, 0.002};
      const Vec3 outwards = Vec3{side * 0.45, 0.88, -0.1}.normalized();
      const auto entry = BoneSurface(level).first_hit(target + 0.2 * outwards, -outwards, 0.2);
      made.screws.push_back(
          {level.label, side > 0 ? Side::kLeft : Side::kRight, {entry->point}, {target}});
    }
  }
  return made;
}

std::optional<TestCase> visible_human_case(const std::vector<std::string>& operated) {
  const std::string folder = test::test_data("anatomy/visible-human").string() + "/";
  std::ifstream file(folder + "case.json");
  if (!file) {
    return std::nullopt;
  }
  TestCase made;
  made.room.phrases = kSaid;
  made.room.tools = test_tools();
  made.room.operated = operated;
  const auto description = nlohmann::json::parse(file);
  for (const auto& entry : description["levels"]) {
    RoomLevel level = read_stl(folder + entry["model"].get<std::string>());
    level.label = entry["label"];
    level.spine_from_vertebra = pose_from(entry["spine_from_model"]);
    std::ifstream plan_file(folder + entry["plan"].get<std::string>());
    const auto plan = nlohmann::json::parse(plan_file);
    for (const auto& screw : plan["screws"]) {
      made.screws.push_back({level.label,
                             screw["side"] == "left" ? Side::kLeft : Side::kRight,
                             {vector_from(screw["entry"])},
                             {vector_from(screw["target"])}});
    }
    made.room.levels.push_back(std::move(level));
  }
  return made;
}

}  // namespace orthonav::sim
