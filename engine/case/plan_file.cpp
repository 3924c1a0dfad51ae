#include "engine/case/plan_file.h"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "base/length_text.h"
#include "engine/case/markups_plan.h"
#include "engine/case/operation.h"
#include "engine/case/screw_place.h"
#include "engine/io/json_document.h"
#include "engine/io/json_writer.h"
#include "engine/io/slicer_markups.h"
#include "engine/io/text_fields.h"

namespace orthonav::engine {
namespace {

std::optional<nav::Side> side_from(const std::string& text) {
  if (text == "left") {
    return nav::Side::kLeft;
  }
  if (text == "right") {
    return nav::Side::kRight;
  }
  return std::nullopt;
}

Result<Plan> checked(const std::string& path, Plan plan) {
  if (plan.screws.empty()) {
    return Error{path + ": has no screws"};
  }
  for (StatedScrew& screw : plan.screws) {
    screw.where = path + ": " + screw.where;
    if (const auto problem = ill_sized(screw.entry, screw.target, screw.radius_m)) {
      return Error{screw.where + " " + *problem};
    }
  }
  return plan;
}

/// Why two files can't form one plan, up to the other's name; empty if they can.
std::optional<std::string> unlike(const Plan& one, const Plan& other) {
  if (!one.level.empty() && !other.level.empty() && one.level != other.level) {
    return "plans " + other.level + ", must be " + one.level + " as in";
  }
  if (one.axes != other.axes || one.metres_per_unit != other.metres_per_unit) {
    return "must have the frame and the unit of";
  }
  return std::nullopt;
}

void read_frame(const JsonNode& root, Plan& plan) {
  const std::string units = root.text("units");
  const std::string frame = root.text("frame");
  const auto metres = metres_per_unit_from(units);
  const auto axes = axes_from(frame);
  if (!metres) {
    root.refuse("units", "is \"" + units + "\", must be mm or m");
  }
  if (!axes) {
    root.refuse("frame", "is \"" + frame + "\", must be LPS or RAS");
  }
  plan.metres_per_unit = metres.value_or(1.0);
  plan.axes = axes.value_or(Axes::kLps);
}

/// The reason must be one line, since reports show it in one.
std::string accepted_breach(const JsonNode& screw) {
  constexpr std::size_t kMost = 200;
  constexpr const char* kKey = "accept_breach";
  if (!screw.has(kKey)) {
    return {};
  }
  const std::string reason = screw.text(kKey);
  if (reason.find_first_not_of(" \t") == std::string::npos) {
    screw.refuse(kKey, "must say why");
  }
  if (reason.size() > kMost) {
    screw.refuse(kKey, "is " + std::to_string(reason.size()) + " bytes long, limit " +
                           std::to_string(kMost));
  }
  if (std::any_of(reason.begin(), reason.end(),
                  [](unsigned char c) { return std::iscntrl(c) != 0; })) {
    screw.refuse(kKey, "must be one line");
  }
  return reason;
}

Result<Plan> plan_from_json(const Result<JsonDocument>& document) {
  if (!document) {
    return document.error();
  }
  const JsonNode root = document->root();
  Plan plan;
  read_frame(root, plan);
  plan.level = root.text_or("level", "");
  const auto point = [&plan](const JsonNode& node, const char* key) {
    return Point<Vertebra>{to_lps(node.vec3(key), plan.axes) * plan.metres_per_unit};
  };
  for (const JsonNode& node : root.list("screws")) {
    const std::string side_text = node.text("side");
    const auto side = side_from(side_text);
    if (!side) {
      node.refuse("side", "is \"" + side_text + "\", must be left or right");
    }
    const double radius = node.number("radius");
    if (!(radius > 0.0)) {
      node.refuse("radius", "must be greater than 0");
    }
    plan.screws.push_back({"screws[" + std::to_string(plan.screws.size()) + "]", side,
                           point(node, "entry"), point(node, "target"),
                           radius * plan.metres_per_unit, accepted_breach(node)});
  }
  if (Status status = document->status(); !status) {
    return status.error();
  }
  return plan;
}

/// The screw's place decides the side; the file can only confirm it, unless the place leaves it
/// open.
Result<nav::Side> side_on(const nav::TriangleMesh& bone, const StatedScrew& screw) {
  const OffMidline off = off_midline(bone, screw.entry, screw.target);
  const auto measured = off.side();
  if (measured && screw.side.value_or(*measured) != *measured) {
    const std::string said = name_of(*screw.side);
    return Error{"says " + said + ", but its entry lies " + to_the_side(off.entry_m) +
                 " of the bone's midline, must lie to the " + said};
  }
  if (measured || screw.side) {
    return measured ? *measured : *screw.side;
  }
  if (off.crosses()) {
    return Error{"must say left or right: it crosses the bone's midline, from " +
                 to_the_side(off.entry_m) + " to " + to_the_side(off.target_m)};
  }
  return Error{"must say left or right: its entry lies only " + to_the_side(off.entry_m) +
               " of the bone's midline, " + in_mm(kLeastOffMidline_m) + " would tell the side"};
}

}  // namespace

Result<Plan> load_plan(const std::string& path) {
  // The legacy format holds points without lines, so it does not say which of them form a screw.
  if (lower_case(path).ends_with(".fcsv")) {
    return Error{path + ": an .fcsv file holds no lines; save the screws as .mrk.json lines"};
  }
  if (Status s = check_no_scene(path, "save the screws' lines as .mrk.json"); !s) {
    return s.error();
  }
  auto plan = is_markups_name(path) ? plan_from_markups(load_markups(path), path)
                                    : plan_from_json(JsonDocument::read(path));
  return plan ? checked(path, std::move(*plan)) : plan;
}

Result<Plan> parse_plan(const std::string& text, const std::string& name) {
  const auto document = JsonDocument::parse(text, name);
  const bool of_slicer = document && document->root().has("markups");
  auto plan =
      of_slicer ? plan_from_markups(markups_in(document, name), name) : plan_from_json(document);
  return plan ? checked(name, std::move(*plan)) : plan;
}

Result<Plan> load_plan(std::span<const std::string> paths) {
  Plan all;
  for (const std::string& path : paths) {
    Result<Plan> plan = load_plan(path);
    if (!plan) {
      return plan;
    }
    if (&path == &paths.front()) {
      all = std::move(*plan);
      continue;
    }
    if (const auto problem = unlike(all, *plan)) {
      return Error{path + ": " + *problem + " " + paths.front()};
    }
    all.level = all.level.empty() ? plan->level : all.level;
    all.screws.insert(all.screws.end(), plan->screws.begin(), plan->screws.end());
  }
  return all;
}

Result<std::vector<nav::ScrewPlan>> screws_on(const nav::TriangleMesh& bone, const Plan& plan) {
  const nav::SurfaceIndex surface(bone);
  std::vector<nav::ScrewPlan> screws;
  for (const StatedScrew& stated : plan.screws) {
    const std::string which = stated.where + " ";
    if (const auto problem =
            misplaced(surface, stated.entry, stated.target, stated.radius_m, plan.axes)) {
      return Error{which + *problem};
    }
    const auto side = side_on(bone, stated);
    if (!side) {
      return Error{which + side.error().message};
    }
    for (const nav::ScrewPlan& other : screws) {
      if (other.side == *side) {
        return Error{which + "is the second one on the " + name_of(*side) + ", one is the limit"};
      }
    }
    screws.push_back({*side, stated.entry, stated.target, stated.radius_m, stated.accepted_breach});
  }
  return screws;
}

Status save_plan(const std::string& path, const std::string& level,
                 std::span<const nav::ScrewPlan> screws) {
  nlohmann::ordered_json root = {{"units", "mm"}, {"frame", "LPS"}};
  if (!level.empty()) {
    root["level"] = level;
  }
  root["screws"] = nlohmann::ordered_json::array();
  for (const nav::ScrewPlan& screw : screws) {
    nlohmann::ordered_json entry;
    entry["side"] = name_of(screw.side);
    entry["entry"] = vector_mm(screw.entry.v);
    entry["target"] = vector_mm(screw.target.v);
    entry["radius"] = screw.radius_m * 1e3;
    if (!screw.accepted_breach.empty()) {
      entry["accept_breach"] = screw.accepted_breach;
    }
    root["screws"].push_back(entry);
  }
  return write_json(path, root);
}

}  // namespace orthonav::engine
