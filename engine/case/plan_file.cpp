#include "engine/case/plan_file.h"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "base/length_text.h"
#include "engine/case/line_name.h"
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

Result<Plan> checked(Plan plan) {
  if (plan.screws.empty()) {
    return Error{plan.path + ": has no screws"};
  }
  for (const StatedScrew& screw : plan.screws) {
    if (const auto problem = ill_sized(screw.entry, screw.target, screw.radius_m)) {
      return Error{plan.path + ": " + screw.where + " " + *problem};
    }
  }
  return plan;
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

/// The reason stands where a report shows it: one line.
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

Result<Plan> plan_from_json(const std::string& path) {
  const Result<JsonDocument> document = JsonDocument::read(path);
  if (!document) {
    return document.error();
  }
  const JsonNode root = document->root();
  Plan plan;
  plan.path = path;
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
  return checked(std::move(plan));
}

/// The radius that `diameter=5.5` states, in the file's unit; 0 where it does not.
double stated_radius(const Markup& markup) {
  for (const std::string& text : {lower_case(markup.description), lower_case(markup.name)}) {
    std::size_t at = text.find("diameter");
    if (at == std::string::npos) {
      continue;
    }
    at = text.find_first_not_of(" \t", at + std::string("diameter").size());
    if (at == std::string::npos || text[at] != '=') {
      continue;
    }
    at = text.find_first_not_of(" \t", at + 1);
    if (at == std::string::npos) {
      continue;
    }
    const std::size_t end = std::min(text.find_first_not_of("0123456789.", at), text.size());
    return number_from(text.substr(at, end - at)).value_or(0.0) / 2.0;
  }
  return 0.0;
}

/// What `accept_breach=` in the description says, up to the end of the line.
std::string accepted_breach(const Markup& markup) {
  constexpr std::string_view kKey = "accept_breach=";
  const std::size_t key = markup.description.find(kKey);
  if (key == std::string::npos) {
    return {};
  }
  std::string reason = markup.description.substr(key + kKey.size());
  reason.resize(std::min(reason.find_first_of("\r\n"), reason.size()));
  return reason;
}

/// A name may be of any length and hold anything; a message is one line.
std::string quoted(const std::string& name) {
  constexpr std::size_t kMost = 60;
  std::string shown = name.size() <= kMost ? name : name.substr(0, kMost) + "...";
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
  return "\"" + shown + "\"";
}

std::optional<nav::Side> side_of(const LineName& name) {
  if (name.left == name.right) {
    return std::nullopt;
  }
  return name.left ? nav::Side::kLeft : nav::Side::kRight;
}

Result<Plan> plan_from_markups(const std::string& path) {
  const Result<MarkupsFile> file = load_markups(path);
  if (!file) {
    return file.error();
  }
  Plan plan;
  plan.path = path;
  plan.axes = file->axes;
  plan.metres_per_unit = file->metres_per_unit;
  for (const Markup& markup : file->markups) {
    if (markup.type != "Line") {
      continue;
    }
    const std::string where = "line " + quoted(markup.name);
    if (markup.points.size() != 2) {
      return Error{path + ": " + where + " has " + std::to_string(markup.points.size()) +
                   " defined points, must be 2"};
    }
    const LineName name = parsed_line_name(markup.name);
    if (name.left && name.right) {
      return Error{path + ": " + where + " says both left and right"};
    }
    if (!plan.level.empty() && !name.level.empty() && name.level != plan.level) {
      return Error{path + ": holds screws of " + plan.level + " and " + name.level +
                   ", must be one level a file"};
    }
    if (!name.level.empty()) {
      plan.level = name.level;
    }
    const auto point = [&](std::size_t i) {
      return Point<Vertebra>{to_lps(markup.points[i].position, plan.axes) * plan.metres_per_unit};
    };
    plan.screws.push_back({where, side_of(name), point(0), point(1),
                           stated_radius(markup) * plan.metres_per_unit, accepted_breach(markup)});
  }
  return checked(std::move(plan));
}

/// The place tells the side; what the file says may only confirm it, unless the place leaves it
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
  // The legacy format holds points without lines: nothing says which of them make a screw.
  if (lower_case(path).ends_with(".fcsv")) {
    return Error{path + ": an .fcsv file holds no lines; save the screws as .mrk.json lines"};
  }
  return is_markups_name(path) ? plan_from_markups(path) : plan_from_json(path);
}

Result<std::vector<nav::ScrewPlan>> screws_on(const nav::TriangleMesh& bone, const Plan& plan) {
  const nav::SurfaceIndex surface(bone);
  std::vector<nav::ScrewPlan> screws;
  for (const StatedScrew& stated : plan.screws) {
    const std::string which = plan.path + ": " + stated.where + " ";
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
