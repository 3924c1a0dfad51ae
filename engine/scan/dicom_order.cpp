#include "engine/scan/dicom_order.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "base/angle.h"
#include "base/printed.h"
#include "nav/statistics/median.h"

namespace orthonav::engine {
namespace {

/// Rounding of the header's decimal digits.
constexpr double kSame_m = 1e-5;
constexpr double kSameDirection = 1e-3;
/// Some writers round positions to 0.1 mm, first and last slice too.
constexpr double kMostOff_m = 0.0001 + kSame_m;
constexpr double kMissingGap = 1.5;  ///< times the usual gap
constexpr double kMaxTilt_deg = 0.2;

std::string name_of(const SliceHeader& slice) {
  return std::filesystem::path(slice.file).filename().string();
}

Status check_alike(const std::vector<SliceHeader>& slices) {
  const SliceHeader& first = slices.front();
  const bool square = std::abs(first.row.dot(first.column)) < kSameDirection &&
                      std::abs(first.row.norm() - 1.0) < kSameDirection &&
                      std::abs(first.column.norm() - 1.0) < kSameDirection;
  if (!square) {
    return Error{name_of(first) + ": its rows and columns are not at right angles"};
  }
  for (const SliceHeader& slice : slices) {
    const char* what = nullptr;
    if (slice.size != first.size) {
      what = "number of rows or columns";
    } else if (std::abs(slice.spacing_m[0] - first.spacing_m[0]) > kSame_m ||
               std::abs(slice.spacing_m[1] - first.spacing_m[1]) > kSame_m) {
      what = "spacing";
    } else if ((slice.row - first.row).norm() > kSameDirection ||
               (slice.column - first.column).norm() > kSameDirection) {
      what = "orientation";
    }
    if (what != nullptr) {
      return Error{name_of(slice) + " has another " + what + " than " + name_of(first) +
                   " of the same series"};
    }
  }
  return {};
}

/// The step from slice to slice: the stack's whole length by its gaps.
Result<Vec3> even_step_m(const std::vector<SliceHeader>& slices, Vec3 normal) {
  std::vector<double> gaps_m;
  for (std::size_t i = 1; i < slices.size(); ++i) {
    gaps_m.push_back((slices[i].position_m - slices[i - 1].position_m).dot(normal));
  }
  const double usual_m = nav::median(gaps_m);
  for (std::size_t i = 0; i < gaps_m.size(); ++i) {
    const std::string between = name_of(slices[i]) + " and " + name_of(slices[i + 1]);
    if (gaps_m[i] < kSame_m) {
      return Error{between + " lie at the same place"};
    }
    if (gaps_m[i] >= kMissingGap * usual_m) {
      return Error{between + printed(" are %.2f mm apart, the others %.2f mm: slices are missing",
                                     gaps_m[i] * 1e3, usual_m * 1e3)};
    }
  }
  const Vec3 first_m = slices.front().position_m;
  const Vec3 step_m = (slices.back().position_m - first_m) / static_cast<double>(gaps_m.size());
  for (std::size_t i = 1; i < slices.size(); ++i) {
    const double off_m = (slices[i].position_m - first_m - static_cast<double>(i) * step_m).norm();
    if (!(off_m <= kMostOff_m)) {
      return Error{name_of(slices[i]) +
                   beside_limit(" lies %.2f mm off an evenly spaced stack, limit %.2f mm: "
                                "slices are shifted or unevenly spaced; resample them",
                                off_m * 1e3, kMostOff_m * 1e3)};
    }
  }
  return step_m;
}

double tilt_of_deg(Vec3 step_m, Vec3 normal) {
  return angle_between_rad(step_m, normal) * kDegreesPerRadian;
}

Vec3 normal_of(const SliceHeader& slice) { return slice.row.cross(slice.column).normalized(); }

void sort_along(std::vector<SliceHeader>& slices, Vec3 normal) {
  std::stable_sort(slices.begin(), slices.end(), [&](const SliceHeader& a, const SliceHeader& b) {
    return a.position_m.dot(normal) < b.position_m.dot(normal);
  });
}

std::map<std::string, std::vector<SliceHeader>> by_series(std::span<const SliceHeader> slices) {
  std::map<std::string, std::vector<SliceHeader>> series;
  for (const SliceHeader& slice : slices) {
    series[slice.series].push_back(slice);
  }
  return series;
}

}  // namespace

Result<std::vector<SliceHeader>> one_series(std::span<const SliceHeader> slices,
                                            const std::string& wanted) {
  auto series = by_series(slices);
  const auto is_ct = [](const auto& each) {
    return std::any_of(each.second.begin(), each.second.end(),
                       [](const SliceHeader& slice) { return slice.ct; });
  };
  if (wanted.empty() && std::any_of(series.begin(), series.end(), is_ct)) {
    std::erase_if(series, [&](const auto& each) { return !is_ct(each); });
  }
  if (series.empty()) {
    return Error{"no DICOM slices"};
  }
  if (const auto found = series.find(wanted); !wanted.empty() && found != series.end()) {
    return found->second;
  }
  if (wanted.empty() && series.size() == 1) {
    return series.begin()->second;
  }
  std::string list;
  for (const auto& [uid, members] : series) {
    list +=
        (list.empty() ? "" : "; ") + uid + " (" + std::to_string(members.size()) + " slices" +
        (members.front().description.empty() ? "" : ", \"" + members.front().description + "\"") +
        ")";
  }
  return Error{(wanted.empty() ? "several series, choose one with --series: "
                               : "no series " + wanted + "; there are: ") +
               list};
}

Result<SliceStack> stacked(std::vector<SliceHeader> slices) {
  for (const SliceHeader& slice : slices) {
    if (!slice.problem.empty()) {
      return Error{name_of(slice) + " " + slice.problem};
    }
  }
  if (slices.size() < 2) {
    return Error{"a single slice makes no volume"};
  }
  if (Status s = check_alike(slices); !s) {
    return s.error();
  }
  const Vec3 normal = normal_of(slices.front());
  sort_along(slices, normal);
  const auto step_m = even_step_m(slices, normal);
  if (!step_m) {
    return step_m.error();
  }
  if (const double tilt_deg = tilt_of_deg(*step_m, normal); tilt_deg > kMaxTilt_deg) {
    return Error{
        beside_limit("the stack leans by %.1f°, limit %.1f°: gantry tilt; resample it first",
                     tilt_deg, kMaxTilt_deg)};
  }
  SliceStack stack;
  const SliceHeader& first = slices.front();
  stack.grid.size = {first.size[0], first.size[1], static_cast<int>(slices.size())};
  stack.grid.origin_m = first.position_m;
  stack.grid.spacing_m = {first.spacing_m[0], first.spacing_m[1], step_m->dot(normal)};
  stack.grid.directions = Mat3::from_columns(first.row, normal.cross(first.row), normal);
  stack.slices = std::move(slices);
  return stack;
}

std::vector<SeriesSummary> summaries_of(std::span<const SliceHeader> slices) {
  std::vector<SeriesSummary> summaries;
  for (auto& [uid, members] : by_series(slices)) {
    const SliceHeader& first = members.front();
    SeriesSummary summary{uid,
                          first.description,
                          first.modality,
                          static_cast<int>(members.size()),
                          first.size,
                          {first.spacing_m[0], first.spacing_m[1], 0.0},
                          0.0,
                          {}};
    auto stack = stacked(members);
    if (stack) {
      summary.spacing_m[2] = stack->grid.spacing_m.z;
    } else {
      summary.problem = stack.error().message;
    }
    if (members.size() > 1 && first.problem.empty()) {
      auto sorted = members;
      const Vec3 normal = normal_of(first);
      sort_along(sorted, normal);
      const Vec3 along = sorted.back().position_m - sorted.front().position_m;
      summary.tilt_deg = along.norm() > kSame_m ? tilt_of_deg(along, normal) : 0.0;
    }
    summaries.push_back(std::move(summary));
  }
  return summaries;
}

}  // namespace orthonav::engine
