#include "engine/case/screw_sizes.h"

#include <algorithm>
#include <cmath>

#include "base/printed.h"
#include "nav/guidance/changed_screw.h"

namespace orthonav::engine {
namespace {

constexpr double kSameDiameter_m = 0.00005;
constexpr double kSameLength_m = 0.0005;
constexpr double kAnotherLength_m = 0.00005;

/// The nearest value that is more than `apart` beyond `from`, if any.
std::optional<double> next_of(const std::vector<double>& ascending, double from, bool up,
                              double apart) {
  std::optional<double> found;
  for (const double value : ascending) {
    if (up && value > from + apart) {
      return value;
    }
    if (!up && value < from - apart) {
      found = value;
    }
  }
  return found;
}

bool has_length_in(const ScrewSize& size, double length_m) {
  return std::any_of(size.lengths_m.begin(), size.lengths_m.end(), [length_m](double listed_m) {
    return std::abs(listed_m - length_m) <= kSameLength_m;
  });
}

void check_size(const ScrewSize& size, std::vector<std::string>& problems) {
  const std::string where = printed("screw of %.1f mm: ", size.diameter_m * 1e3);
  if (!(size.diameter_m >= 0.002 && size.diameter_m <= 0.012)) {
    problems.push_back(where + "diameter must lie in [2, 12] mm");
  }
  if (size.lengths_m.empty()) {
    problems.push_back(where + "has no length, at least 1 needed");
  }
  for (std::size_t i = 0; i < size.lengths_m.size(); ++i) {
    const double length_m = size.lengths_m[i];
    if (!(length_m >= 0.010 && length_m <= 0.120)) {
      problems.push_back(where +
                         printed("length %.1f mm must lie in [10, 120] mm", length_m * 1e3));
    } else if (i > 0 && !(length_m > size.lengths_m[i - 1] + 2.0 * kSameLength_m)) {
      problems.push_back(
          where +
          printed("length %.1f mm must be over 1 mm more than the one before", length_m * 1e3));
    }
  }
  if (size.head_to_seat_m && !(*size.head_to_seat_m >= -0.015 && *size.head_to_seat_m <= 0.030)) {
    problems.push_back(where + "seat must lie in [-15, 30] mm");
  }
}

}  // namespace

ScrewSizes ScrewSizes::built_in() {
  ScrewSizes sizes;
  for (const double diameter_mm : {4.5, 5.0, 5.5, 6.0, 6.5, 7.0, 7.5, 8.5}) {
    ScrewSize size;
    size.diameter_m = diameter_mm * 1e-3;
    for (int length_mm = 25; length_mm <= 60; length_mm += 5) {
      size.lengths_m.push_back(length_mm * 1e-3);
    }
    sizes.by_diameter.push_back(std::move(size));
  }
  return sizes;
}

std::vector<nav::ImplantSize> ScrewSizes::implants() const {
  std::vector<nav::ImplantSize> out;
  for (const ScrewSize& size : by_diameter) {
    for (const double length_m : size.lengths_m) {
      out.push_back({size.diameter_m, length_m});
    }
  }
  return out;
}

const ScrewSize* ScrewSizes::of_diameter(double diameter_m) const {
  const auto found =
      std::find_if(by_diameter.begin(), by_diameter.end(), [diameter_m](const ScrewSize& size) {
        return std::abs(size.diameter_m - diameter_m) <= kSameDiameter_m;
      });
  return found == by_diameter.end() ? nullptr : &*found;
}

bool ScrewSizes::has(double diameter_m, double length_m) const {
  const ScrewSize* size = of_diameter(diameter_m);
  return size != nullptr && has_length_in(*size, length_m);
}

bool ScrewSizes::has_length(double length_m) const {
  return std::any_of(by_diameter.begin(), by_diameter.end(),
                     [length_m](const ScrewSize& size) { return has_length_in(size, length_m); });
}

std::optional<double> ScrewSizes::next_diameter_m(double diameter_m, bool thicker) const {
  std::vector<double> diameters_m;
  for (const ScrewSize& size : by_diameter) {
    diameters_m.push_back(size.diameter_m);
  }
  return next_of(diameters_m, diameter_m, thicker, kSameDiameter_m);
}

std::optional<double> ScrewSizes::next_length_m(double diameter_m, double length_m,
                                                bool longer) const {
  const auto nearest = std::min_element(
      by_diameter.begin(), by_diameter.end(), [diameter_m](const ScrewSize& a, const ScrewSize& b) {
        return std::abs(a.diameter_m - diameter_m) < std::abs(b.diameter_m - diameter_m);
      });
  if (nearest == by_diameter.end()) {
    return std::nullopt;
  }
  return next_of(nearest->lengths_m, length_m, longer, kAnotherLength_m);
}

std::optional<double> ScrewSizes::head_to_seat_m(double diameter_m) const {
  const ScrewSize* size = of_diameter(diameter_m);
  return size != nullptr ? size->head_to_seat_m : std::nullopt;
}

std::vector<std::string> sizes_not_listed(const Operation& operation, const ScrewSizes& sizes) {
  std::vector<std::string> lines;
  for (const OperatedLevel& level : operation.levels) {
    for (const nav::ScrewPlan& screw : level.screws) {
      const double diameter_m = 2.0 * screw.radius_m;
      const double length_m = nav::screw_length_m(screw);
      const bool stated = diameter_m > 0.0;
      if (stated ? sizes.has(diameter_m, length_m) : sizes.has_length(length_m)) {
        continue;
      }
      const std::string size = stated ? printed("%.1f x %.1f mm", diameter_m * 1e3, length_m * 1e3)
                                      : printed("length %.1f mm", length_m * 1e3);
      lines.push_back(level.label + " " + name_of(screw.side) + ": " + size +
                      " is not in the list of screws");
    }
  }
  return lines;
}

std::vector<std::string> ScrewSizes::check() const {
  std::vector<std::string> problems;
  if (by_diameter.empty()) {
    problems.push_back("no screw, at least 1 needed");
  }
  for (std::size_t i = 0; i < by_diameter.size(); ++i) {
    check_size(by_diameter[i], problems);
    if (i > 0 &&
        !(by_diameter[i].diameter_m > by_diameter[i - 1].diameter_m + 2.0 * kSameDiameter_m)) {
      problems.push_back(
          printed("screw of %.1f mm: must be over 0.1 mm thicker than the one before",
                  by_diameter[i].diameter_m * 1e3));
    }
  }
  return problems;
}

}  // namespace orthonav::engine
