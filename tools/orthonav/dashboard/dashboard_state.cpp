#include "tools/orthonav/dashboard/dashboard_state.h"

#include <nlohmann/json.hpp>

#include "base/angle.h"
#include "base/pose_status_name.h"
#include "engine/session/steps/guiding.h"
#include "engine/session/text/wording.h"

namespace orthonav::tools {
namespace {

using Json = nlohmann::ordered_json;

Json number(const nav::ScrewNumbers& numbers, engine::NumberRow row, const char* name) {
  std::string text;
  engine::append_number(text, numbers, row);
  return {{"name", name}, {"text", text}, {"sure", engine::number_of(numbers, row).sure}};
}

const char* grade_name(engine::Grade grade) {
  switch (grade) {
    case engine::Grade::kGood:
      return "good";
    case engine::Grade::kFair:
      return "fair";
    case engine::Grade::kPoor:
      break;
  }
  return "poor";
}

/// Null if the surgeon is shown no number.
Json guidance_of(const engine::Guidance& g, const engine::GradeLimits& limits) {
  if (g.blank || !g.tool || !g.tool->measured || g.level >= g.levels.size()) {
    return nullptr;
  }
  const engine::LevelState& level = g.levels[g.level];
  Json out = {{"level", level.plan.label},
              {"side", name_of(level.plan.screws[g.screw].side)},
              {"angle", engine::angle_text(g.tool->measured->angle_rad)},
              {"angle_deg", g.tool->measured->angle_rad * kDegreesPerRadian},
              {"grade", grade_name(engine::grade_of(g.tool->measured->angle_rad, limits))},
              {"to_entry_mm", g.tool->measured->tip_to_entry_m * 1e3},
              {"to_target_mm", g.tool->measured->to_target_m * 1e3},
              {"registration_only", level.registration_only()},
              {"numbers", Json::array()}};
  if (g.tool->numbers) {
    const nav::ScrewNumbers& numbers = *g.tool->numbers;
    using enum engine::NumberRow;
    out["numbers"] = {number(numbers, kTipCranial, "tip"), number(numbers, kTipMedial, "tip"),
                      number(numbers, kAimCranial, "aims"), number(numbers, kAimMedial, "aims")};
  }
  if (g.tool->shown_clearance) {
    std::string text;
    engine::append_clearance(text, g.tool->shown_clearance->least_tenths);
    out["clearance"] = text;
  }
  return out;
}

Json level_of(const engine::LevelState& level) {
  Json out = {{"label", level.plan.label},
              {"registered", level.registration.has_value()},
              {"accepted", level.usable()},
              {"screws", Json::array()}};
  if (level.registration) {
    out["rmse_mm"] = level.registration->rmse_m * 1e3;
    out["expected_error_mm"] = nav::worst_m(level.predicted) * 1e3;
    out["registration_only"] = level.registration_only();
  }
  for (std::size_t i = 0; i < level.plan.screws.size(); ++i) {
    Json screw = {{"side", name_of(level.plan.screws[i].side)},
                  {"done", i < level.screws.size() && level.screws[i].done}};
    if (i < level.screws.size() && level.screws[i].wire.measured) {
      const engine::PlacedWire& wire = *level.screws[i].wire.measured;
      screw["wire_angle_deg"] = wire.axis.angle_rad.value * kDegreesPerRadian;
      screw["wire_entry_mm"] = wire.axis.entry_m.value * 1e3;
      screw["wire_within"] = wire.within();
    }
    out["screws"].push_back(std::move(screw));
  }
  return out;
}

}  // namespace

std::string dashboard_state(const engine::Session& session, const engine::Guidance& guidance,
                            const engine::GradeLimits& limits, double time_s,
                            const std::deque<std::string>& messages) {
  std::string status;
  engine::append_detail(status, guidance.status);
  Json out = {
      {"time_s", time_s},
      {"step", engine::step_text(guidance.status.at)},
      {"status", status},
      {"frame_of_reference", guidance.anchor != nullptr ? "patient reference" : "headset's map"},
      {"guidance", guidance_of(guidance, limits)},
      {"levels", Json::array()},
      {"tools", Json::array()},
      {"messages", messages}};
  for (const engine::LevelState& level : guidance.levels) {
    out["levels"].push_back(level_of(level));
  }
  const auto tools = session.tracker().tools();
  for (const nav::ToolState& state : session.tool_states()) {
    out["tools"].push_back({{"name", tools[state.tool].name},
                            {"role", nav::name_of(tools[state.tool].role)},
                            {"status", name_of(state.world_from_marker.status)}});
  }
  return out.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace orthonav::tools
