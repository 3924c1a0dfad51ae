#include "tools/orthonav/igtl/igtl_messages.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/angle.h"
#include "engine/session/text/wording.h"
#include "nav/guidance/screw_cylinder.h"

namespace orthonav::tools {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kDeviceBytes = 20;

void append(Bytes& out, const Bytes& message) {
  out.insert(out.end(), message.begin(), message.end());
}

igtl::Label label_of(const std::string& device, Timestamp time) {
  return {device, igtl_stamp(time)};
}

std::array<float, 3> in_mm(Vec3 v_m) {
  return {static_cast<float>(v_m.x * 1e3), static_cast<float>(v_m.y * 1e3),
          static_cast<float>(v_m.z * 1e3)};
}

/// Converts a model's point from LPS.
Vec3 ras_of(Vec3 lps) { return {-lps.x, -lps.y, lps.z}; }

/// Half a turn about z: LPS from RAS, and back.
Mat3 half_turn() { return Mat3::from_columns({-1, 0, 0}, {0, -1, 0}, {0, 0, 1}); }

/// The frame to which everything is relative.
struct Base {
  std::string name = "World";
  Transform<Marker, World> base_from_world;  ///< the identity if World is the base
};

Base base_of(const engine::Guidance& guidance) {
  if (guidance.anchor == nullptr || guidance.anchor->places.empty()) {
    return {};
  }
  return {"Reference", guidance.anchor->places.front().anchored_from_marker.inverse()};
}

void append_tools(const engine::Session& session, const Base& base, Timestamp time, Bytes& out) {
  for (const nav::ToolState& state : session.tool_states()) {
    const nav::ToolGeometry& tool = session.geometry(state.tool);
    const bool is_base = tool.role == nav::ToolRole::kReference && base.name == "Reference";
    if (state.world_from_marker.status != PoseStatus::kMeasured || is_base ||
        igtl_name_is_taken(session.tracker().tools(), state.tool, base.name)) {
      continue;
    }
    const auto base_from_marker = base.base_from_world * state.world_from_marker.value;
    const Vec3 tip_m = (base_from_marker * tool.tip_in_marker).v;
    append(out, igtl::packed(label_of(igtl_device(tool.name, base.name), time),
                             igtl_values(base_from_marker.rotation(), tip_m)));
  }
}

nlohmann::ordered_json numbers_of(const engine::Guidance& guidance) {
  nlohmann::ordered_json out = {{"step", std::string(name_of(guidance.step))}, {"guiding", false}};
  if (!guidance.tool || !guidance.tool->measured || guidance.blank ||
      guidance.level >= guidance.levels.size()) {
    return out;
  }
  const engine::LevelState& level = guidance.levels[guidance.level];
  const nav::ScrewGuidance& g = *guidance.tool->measured;
  out["guiding"] = true;
  out["level"] = level.plan.label;
  out["side"] = name_of(level.plan.screws[guidance.screw].side);
  out["angle_deg"] = g.angle_rad * kDegreesPerRadian;
  out["tip_to_entry_mm"] = g.tip_to_entry_m * 1e3;
  out["tip_off_axis_mm"] = g.tip_off_axis_m * 1e3;
  out["depth_mm"] = g.depth_m * 1e3;
  out["to_target_mm"] = g.to_target_m * 1e3;
  if (guidance.tool->clearance) {
    out["clearance_mm"] = guidance.tool->clearance->least.clearance_m * 1e3;
  }
  return out;
}

/// The side of a screw's cylinder and both ends, in the model's RAS.
Bytes cylinder(const igtl::Label& label, const nav::ScrewCylinder& screw) {
  constexpr std::uint32_t kSides = 24;
  const Vec3 other = std::abs(screw.direction.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
  const Vec3 across = screw.direction.cross(other).normalized();
  const Vec3 athwart = screw.direction.cross(across);
  const Vec3 tip_m = screw.entry.v + screw.length_m * screw.direction;
  std::vector<std::array<float, 3>> points = {in_mm(ras_of(screw.entry.v)), in_mm(ras_of(tip_m))};
  std::vector<igtl::Triangle> triangles;
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const double around = 2.0 * std::numbers::pi * i / kSides;
    const Vec3 out_m = screw.radius_m * (std::cos(around) * across + std::sin(around) * athwart);
    points.push_back(in_mm(ras_of(screw.entry.v + out_m)));
    points.push_back(in_mm(ras_of(tip_m + out_m)));
    const std::uint32_t a = 2 + 2 * i, b = 2 + 2 * ((i + 1) % kSides);
    triangles.push_back({0, b, a});
    triangles.push_back({1, a + 1, b + 1});
    triangles.push_back({a, b, b + 1});
    triangles.push_back({a, b + 1, a + 1});
  }
  return igtl::packed(label, points, triangles);
}

}  // namespace

std::string igtl_device(const std::string& from, const std::string& to) {
  std::string name;
  for (const char c : from) {
    const auto u = static_cast<unsigned char>(c);
    if (std::isalnum(u) != 0) {
      name += static_cast<char>(name.empty() ? std::toupper(u) : std::tolower(u));
    }
  }
  const std::string end = "To" + to;
  name.resize(std::min(name.size(), kDeviceBytes - std::min(kDeviceBytes, end.size())));
  return name + end;
}

bool igtl_name_is_taken(std::span<const nav::ToolGeometry> tools, std::size_t tool,
                        const std::string& to) {
  const auto before = tools.first(tool);
  return std::any_of(before.begin(), before.end(), [&](const nav::ToolGeometry& other) {
    return igtl_device(other.name, to) == igtl_device(tools[tool].name, to);
  });
}

std::uint64_t igtl_stamp(Timestamp time) {
  const auto ns = static_cast<std::uint64_t>(time.time_since_epoch().count());
  constexpr std::uint64_t kSecond = 1000000000;
  return (ns / kSecond) << 32u | ((ns % kSecond) << 32u) / kSecond;
}

igtl::TransformValues igtl_values(const Mat3& rotation, Vec3 translation_m) {
  igtl::TransformValues values{};
  for (std::size_t column = 0; column < 3; ++column) {
    const Vec3 v = rotation.column(column);
    values[3 * column] = static_cast<float>(v.x);
    values[3 * column + 1] = static_cast<float>(v.y);
    values[3 * column + 2] = static_cast<float>(v.z);
  }
  const auto translation_mm = in_mm(translation_m);
  std::copy(translation_mm.begin(), translation_mm.end(), values.begin() + 9);
  return values;
}

std::vector<std::uint8_t> igtl_models(const engine::Guidance& guidance) {
  Bytes out;
  const Base base = base_of(guidance);
  for (const engine::LevelState& level : guidance.levels) {
    if (!level.usable() || guidance.blank) {
      continue;
    }
    const auto base_from_model = base.base_from_world * level.registration->world_from_vertebra;
    append(out,
           igtl::packed(label_of(level.plan.label + "ModelTo" + base.name, guidance.frame_time),
                        igtl_values(base_from_model.rotation() * half_turn(),
                                    base_from_model.translation())));
  }
  return out;
}

std::vector<std::uint8_t> igtl_frame(const engine::Session& session,
                                     const engine::Guidance& guidance) {
  Bytes out;
  const Timestamp time = guidance.frame_time;
  const Base base = base_of(guidance);
  append_tools(session, base, time, out);
  append(out, igtl_models(guidance));
  append(out, igtl::packed_text(label_of("Guidance", time), numbers_of(guidance).dump()));
  return out;
}

std::vector<std::uint8_t> igtl_status(const engine::Session& session,
                                      const engine::Guidance& guidance) {
  igtl::StatusValues status;
  status.name = std::string(name_of(guidance.step));
  engine::append_without_heard(status.message, guidance.status);
  std::string lost;
  const auto tools = session.tracker().tools();
  for (const nav::ToolState& state : session.tool_states()) {
    if (state.world_from_marker.status != PoseStatus::kMeasured) {
      lost += (lost.empty() ? "" : ", ") + tools[state.tool].name;
    }
  }
  if (!lost.empty()) {
    status.message += " | not measured: " + lost;
  }
  return igtl::packed(label_of("orthonav", guidance.frame_time), status);
}

std::vector<std::uint8_t> igtl_answer(const nlohmann::ordered_json& answer, std::uint64_t stamp) {
  // What a client sent may be no UTF-8.
  return igtl::packed_text({"CommandAnswer", stamp},
                           answer.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

std::vector<std::uint8_t> igtl_screws(const std::string& label,
                                      std::span<const nav::ScrewPlan> screws, Timestamp time) {
  Bytes out;
  for (const nav::ScrewPlan& screw : screws) {
    const std::string name = label + name_of(screw.side) + "Screw";
    const auto radius_mm = static_cast<float>(screw.radius_m * 1e3);
    const std::array<igtl::PointValues, 2> points = {
        igtl::PointValues{name + " entry",
                          "Screw",
                          {80, 160, 255, 255},
                          in_mm(ras_of(screw.entry.v)),
                          radius_mm,
                          ""},
        igtl::PointValues{name + " target",
                          "Screw",
                          {80, 255, 120, 255},
                          in_mm(ras_of(screw.target.v)),
                          radius_mm,
                          ""}};
    append(out, igtl::packed(label_of(name, time), std::span<const igtl::PointValues>(points)));
    if (const auto shape = nav::cylinder_of(screw)) {
      append(out, cylinder(label_of(name + "Model", time), *shape));
    }
  }
  return out;
}

std::vector<std::uint8_t> igtl_screws(std::span<const engine::LevelState> levels, Timestamp time) {
  Bytes out;
  for (const engine::LevelState& level : levels) {
    append(out, igtl_screws(level.plan.label, level.plan.screws, time));
  }
  return out;
}

}  // namespace orthonav::tools
