#include <algorithm>
#include <optional>
#include <regex>
#include <string_view>
#include <vector>

#include "base/one_line.h"
#include "base/printed.h"
#include "engine/case/line_name.h"
#include "engine/case/markups_plan.h"
#include "engine/io/slicer_markups.h"
#include "engine/io/text_fields.h"

namespace orthonav::engine {
namespace {

/// The diameters that a text states, in the file's unit: `diameter=5.5`, `Durchmesser: 6,5`,
/// `Ø6.5`, and the size of a screw, `6.5x45`, always mm.
Result<std::vector<double>> diameters_in(const std::string& text, double metres_per_unit) {
  static const std::regex kStated(
      "(?:diameter|durchmesser|\\bdia\\b|\xC3\x98|\xC3\xB8|\xE2\x8C\x80)\\s*[=:]?\\s*"
      "([0-9]+(?:[.,][0-9]+)?)?");
  static const std::regex kSize(
      "(?:^|[^0-9.,])([0-9]{1,2}(?:[.,][0-9]+)?)\\s*(?:mm)?\\s*(?:x|\xC3\x97)\\s*([0-9]{2,3})");
  std::vector<double> found;
  for (std::sregex_iterator at(text.begin(), text.end(), kStated), end; at != end; ++at) {
    if (!(*at)[1].matched) {
      return Error{"names a diameter without a number, must be as in diameter=6.5"};
    }
    found.push_back(number_with_comma((*at)[1]).value_or(0.0));
  }
  for (std::sregex_iterator at(text.begin(), text.end(), kSize), end; at != end; ++at) {
    const double diameter_mm = number_with_comma((*at)[1]).value_or(0.0);
    const double length_mm = number_with_comma((*at)[2]).value_or(0.0);
    if (diameter_mm >= 2.0 && diameter_mm <= 12.0 && length_mm <= 120.0) {
      found.push_back(diameter_mm * 1e-3 / metres_per_unit);
    }
  }
  return found;
}

/// The radius that name or description states, in the file's unit; 0 if none is stated. Refuses two
/// that differ.
Result<double> stated_radius(const Markup& markup, double metres_per_unit) {
  double radius = 0.0;
  for (const std::string& text : {markup.description, markup.name}) {
    constexpr std::size_t kMaxText = 4096;  // std::regex recurses
    const auto diameters = diameters_in(lower_case(text.substr(0, kMaxText)), metres_per_unit);
    if (!diameters) {
      return diameters.error();
    }
    for (const double diameter : *diameters) {
      if (radius != 0.0 && diameter / 2.0 != radius) {
        return Error{printed("states two diameters, %g and %g", 2.0 * radius, diameter)};
      }
      radius = diameter / 2.0;
    }
  }
  return radius;
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
  const auto radius = stated_radius(*pair.markup, plan.metres_per_unit);
  if (!radius) {
    return Error{pair.where + " " + radius.error().message};
  }
  plan.screws.push_back({pair.where, side_of(name), point(0), point(1),
                         *radius * plan.metres_per_unit, accepted_breach(*pair.markup)});
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
