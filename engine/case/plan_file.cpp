#include "engine/case/plan_file.h"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/length_text.h"
#include "engine/case/operation.h"
#include "engine/io/atomic_file.h"
#include "engine/io/json_document.h"
#include "engine/io/slicer_markups.h"
#include "engine/io/text_fields.h"

namespace orthonav::engine {
namespace {

constexpr double kMinScrewLength_m = 0.010;
constexpr double kMaxScrewLength_m = 0.120;
constexpr double kMinRadius_m = 0.001;
constexpr double kMaxRadius_m = 0.006;

std::optional<nav::Side> side_from(const std::string& text) {
  if (text == "left") {
    return nav::Side::kLeft;
  }
  if (text == "right") {
    return nav::Side::kRight;
  }
  return std::nullopt;
}

/// What is wrong with one screw; empty when nothing is. A radius of 0 means none was stated.
std::string problem_of(const nav::ScrewPlan& screw) {
  const double length_m = (screw.target - screw.entry).norm();
  if (!(length_m >= kMinScrewLength_m && length_m <= kMaxScrewLength_m)) {
    return "is " + in_mm(length_m) + " from entry to target, must be " + in_mm(kMinScrewLength_m) +
           " to " + in_mm(kMaxScrewLength_m);
  }
  if (screw.radius_m != 0.0 &&
      !(screw.radius_m >= kMinRadius_m && screw.radius_m <= kMaxRadius_m)) {
    return "has radius " + in_mm(screw.radius_m) + ", must be " + in_mm(kMinRadius_m) + " to " +
           in_mm(kMaxRadius_m);
  }
  return {};
}

Result<Plan> checked(Plan plan, const std::string& path) {
  if (plan.screws.empty()) {
    return Error{path + ": has no screws"};
  }
  int count[2] = {0, 0};
  for (std::size_t i = 0; i < plan.screws.size(); ++i) {
    const nav::ScrewPlan& screw = plan.screws[i];
    const std::string which =
        path + ": screws[" + std::to_string(i) + "] (" + name_of(screw.side) + ") ";
    if (const std::string problem = problem_of(screw); !problem.empty()) {
      return Error{which + problem};
    }
    if (++count[static_cast<int>(screw.side)] > 1) {
      return Error{which + "is the second one on that side, one is the limit"};
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

Result<Plan> plan_from_json(const std::string& path) {
  const Result<JsonDocument> document = JsonDocument::read(path);
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
    plan.screws.push_back({side.value_or(nav::Side::kLeft), point(node, "entry"),
                           point(node, "target"), radius * plan.metres_per_unit});
  }
  if (Status status = document->status(); !status) {
    return status.error();
  }
  return checked(std::move(plan), path);
}

/// Finds `left`/`right` (or a lone L/R) and a level such as `L4` in what a planner wrote.
struct LineName {
  std::optional<nav::Side> side;
  std::string level;
};

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// Letters and the digits after them, in lower case: "L4_Left-2" has l4 and left.
std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t first = i;
    while (i < text.size() && is_letter(text[i])) {
      ++i;
    }
    const bool has_letters = i > first;
    while (i < text.size() && is_digit(text[i])) {
      ++i;
    }
    if (has_letters) {
      words.push_back(lower_case(text.substr(first, i - first)));
    }
    if (i == first) {
      ++i;
    }
  }
  return words;
}

bool is_level(const std::string& word) {
  return (word.size() == 2 || word.size() == 3) &&
         std::string("ctls").find(word[0]) != std::string::npos && is_digit(word[1]) &&
         is_digit(word.back());
}

LineName parsed_name(const std::string& name) {
  LineName parsed;
  for (const std::string& word : words_of(name)) {
    if (word == "left" || word == "l") {
      parsed.side = nav::Side::kLeft;
    }
    if (word == "right" || word == "r") {
      parsed.side = nav::Side::kRight;
    }
    if (!is_level(word)) {
      continue;
    }
    parsed.level = word;
    parsed.level[0] = static_cast<char>(std::toupper(word[0]));
  }
  return parsed;
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

/// Lines without a named side: of two, the one that enters farther to the left is the left one.
bool take_sides_from_positions(std::vector<nav::ScrewPlan>& screws) {
  if (screws.size() != 2 || screws[0].entry.v.x == screws[1].entry.v.x) {
    return false;
  }
  const bool first_is_left = screws[0].entry.v.x > screws[1].entry.v.x;
  screws[0].side = first_is_left ? nav::Side::kLeft : nav::Side::kRight;
  screws[1].side = first_is_left ? nav::Side::kRight : nav::Side::kLeft;
  return true;
}

Result<Plan> plan_from_markups(const std::string& path) {
  const Result<MarkupsFile> file = load_markups(path);
  if (!file) {
    return file.error();
  }
  Plan plan;
  plan.axes = file->axes;
  plan.metres_per_unit = file->metres_per_unit;
  bool every_side_named = true;
  for (const Markup& markup : file->markups) {
    if (markup.type != "Line") {
      continue;
    }
    if (markup.points.size() != 2) {
      return Error{path + ": line \"" + markup.name + "\" has " +
                   std::to_string(markup.points.size()) + " defined points, must be 2"};
    }
    const LineName name = parsed_name(markup.name);
    if (!plan.level.empty() && !name.level.empty() && name.level != plan.level) {
      return Error{path + ": holds screws of " + plan.level + " and " + name.level +
                   ", must be one level a file"};
    }
    if (!name.level.empty()) {
      plan.level = name.level;
    }
    every_side_named = every_side_named && name.side.has_value();
    const auto point = [&](std::size_t i) {
      return Point<Vertebra>{to_lps(markup.points[i].position, plan.axes) * plan.metres_per_unit};
    };
    plan.screws.push_back({name.side.value_or(nav::Side::kLeft), point(0), point(1),
                           stated_radius(markup) * plan.metres_per_unit});
  }
  if (!every_side_named && !take_sides_from_positions(plan.screws)) {
    return Error{path + ": a line's name does not say left or right"};
  }
  return checked(std::move(plan), path);
}

nlohmann::json list_mm(Point<Vertebra> p) { return {p.v.x * 1e3, p.v.y * 1e3, p.v.z * 1e3}; }

}  // namespace

Result<Plan> load_plan(const std::string& path) {
  // The legacy format holds points without lines: nothing says which of them make a screw.
  if (lower_case(path).ends_with(".fcsv")) {
    return Error{path + ": an .fcsv file holds no lines; save the screws as .mrk.json lines"};
  }
  return is_markups_name(path) ? plan_from_markups(path) : plan_from_json(path);
}

Status save_plan(const std::string& path, const Plan& plan) {
  nlohmann::ordered_json root = {{"units", "mm"}, {"frame", "LPS"}};
  if (!plan.level.empty()) {
    root["level"] = plan.level;
  }
  root["screws"] = nlohmann::ordered_json::array();
  for (const nav::ScrewPlan& screw : plan.screws) {
    nlohmann::ordered_json entry;
    entry["side"] = name_of(screw.side);
    entry["entry"] = list_mm(screw.entry);
    entry["target"] = list_mm(screw.target);
    entry["radius"] = screw.radius_m * 1e3;
    root["screws"].push_back(entry);
  }
  const auto replace = nlohmann::ordered_json::error_handler_t::replace;
  return write_file(path, root.dump(1, ' ', false, replace) + "\n");
}

}  // namespace orthonav::engine
