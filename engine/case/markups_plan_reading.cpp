#include <algorithm>
#include <optional>
#include <string_view>

#include "base/one_line.h"
#include "engine/case/line_name.h"
#include "engine/case/markups_plan.h"
#include "engine/io/slicer_markups.h"
#include "engine/io/text_fields.h"

namespace orthonav::engine {
namespace {

/// The radius from `diameter=5.5`, in the file's unit; 0 if none is stated.
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

/// The text after `accept_breach=` in the description, up to the end of the line.
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

/// A name may have any length and content; a message is one line.
std::string quoted(const std::string& name) {
  constexpr std::size_t kMost = 60;
  return "\"" + one_line(name.size() <= kMost ? name : name.substr(0, kMost) + "...") + "\"";
}

std::optional<nav::Side> side_of(const LineName& name) {
  if (name.left == name.right) {
    return std::nullopt;
  }
  return name.left ? nav::Side::kLeft : nav::Side::kRight;
}

/// Two points that make a screw: a line, or two points of a list one after the other.
struct Pair {
  const Markup* markup = nullptr;
  std::string where;
  std::string name;  ///< gives side and level
  std::vector<MarkupPoint> points;
};

/// The lines; if there are none, the points of the lists in pairs.
std::vector<Pair> pairs_of(const MarkupsFile& file) {
  std::vector<Pair> pairs;
  for (const Markup& markup : file.markups) {
    if (markup.type == "Line") {
      pairs.push_back({&markup, "line " + quoted(markup.name), markup.name, markup.points});
    }
  }
  if (!pairs.empty()) {
    return pairs;
  }
  for (const Markup& markup : file.markups) {
    for (std::size_t i = 0; markup.type == "Fiducial" && i < markup.points.size(); i += 2) {
      const auto begin = markup.points.begin() + static_cast<std::ptrdiff_t>(i);
      const auto end = markup.points.end() - begin > 2 ? begin + 2 : markup.points.end();
      pairs.push_back({&markup,
                       "points " + std::to_string(i + 1) + " and " + std::to_string(i + 2) +
                           " of " + quoted(markup.name),
                       markup.name + " " + begin->label,
                       {begin, end}});
    }
  }
  return pairs;
}

Status add(const Pair& pair, Plan& plan) {
  if (pair.points.size() != 2) {
    return Error{pair.where + (pair.points.size() == 1 && pair.markup->type == "Fiducial"
                                   ? ": the second one is missing, screws are pairs of points"
                                   : " has " + std::to_string(pair.points.size()) +
                                         " defined points, must be 2")};
  }
  const LineName name = parsed_line_name(pair.name);
  if (name.left && name.right) {
    return Error{pair.where + " says both left and right"};
  }
  if (!plan.level.empty() && !name.level.empty() && name.level != plan.level) {
    return Error{"holds screws of " + plan.level + " and " + name.level +
                 ", must be one level a file"};
  }
  if (!name.level.empty()) {
    plan.level = name.level;
  }
  const auto point = [&](std::size_t i) {
    return Point<Vertebra>{to_lps(pair.points[i].position, plan.axes) * plan.metres_per_unit};
  };
  plan.screws.push_back({pair.where, side_of(name), point(0), point(1),
                         stated_radius(*pair.markup) * plan.metres_per_unit,
                         accepted_breach(*pair.markup)});
  return {};
}

}  // namespace

Result<Plan> plan_from_markups(const Result<MarkupsFile>& file, const std::string& name) {
  if (!file) {
    return file.error();
  }
  Plan plan;
  plan.axes = file->axes;
  plan.metres_per_unit = file->metres_per_unit;
  for (const Pair& pair : pairs_of(*file)) {
    if (const Status added = add(pair, plan); !added) {
      return Error{name + ": " + added.error().message};
    }
  }
  return plan;
}

}  // namespace orthonav::engine
