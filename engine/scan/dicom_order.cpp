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
constexpr double kGapTolerance_m = 0.00002;

constexpr double kGapFraction = 0.02;
constexpr double kMostTilt_deg = 0.2;

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

/// The distance between neighbours along the normal.
Result<double> even_distance_m(const std::vector<SliceHeader>& slices, Vec3 normal) {
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
    if (std::abs(gaps_m[i] - usual_m) > std::max(kGapTolerance_m, kGapFraction * usual_m)) {
      return Error{between + printed(" are %.2f mm apart, the others %.2f mm: slices are missing",
                                     gaps_m[i] * 1e3, usual_m * 1e3)};
    }
  }
  const double whole_m = (slices.back().position_m - slices.front().position_m).dot(normal);
  return whole_m / static_cast<double>(gaps_m.size());
}

Status check_tilt(const std::vector<SliceHeader>& slices, Vec3 normal) {
  const Vec3 along = slices.back().position_m - slices.front().position_m;
  const double tilt_deg = angle_between_rad(along, normal) * kDegreesPerRadian;
  if (tilt_deg > kMostTilt_deg) {
    return Error{
        beside_limit("the stack leans by %.1f°, limit %.1f°: gantry tilt; resample it first",
                     tilt_deg, kMostTilt_deg)};
  }
  return {};
}

}  // namespace

Result<std::vector<SliceHeader>> one_series(std::span<const SliceHeader> slices,
                                            const std::string& wanted) {
  std::map<std::string, std::vector<SliceHeader>> by_series;
  for (const SliceHeader& slice : slices) {
    by_series[slice.series].push_back(slice);
  }
  if (by_series.empty()) {
    return Error{"no DICOM slices"};
  }
  if (const auto found = by_series.find(wanted); !wanted.empty() && found != by_series.end()) {
    return found->second;
  }
  if (wanted.empty() && by_series.size() == 1) {
    return by_series.begin()->second;
  }
  std::string list;
  for (const auto& [uid, members] : by_series) {
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
  if (slices.size() < 2) {
    return Error{"a single slice makes no volume"};
  }
  if (Status s = check_alike(slices); !s) {
    return s.error();
  }
  const Vec3 normal = slices.front().row.cross(slices.front().column).normalized();
  std::stable_sort(slices.begin(), slices.end(), [&](const SliceHeader& a, const SliceHeader& b) {
    return a.position_m.dot(normal) < b.position_m.dot(normal);
  });
  const auto distance_m = even_distance_m(slices, normal);
  if (!distance_m) {
    return distance_m.error();
  }
  if (Status s = check_tilt(slices, normal); !s) {
    return s.error();
  }
  SliceStack stack;
  const SliceHeader& first = slices.front();
  stack.grid.size = {first.size[0], first.size[1], static_cast<int>(slices.size())};
  stack.grid.origin_m = first.position_m;
  stack.grid.spacing_m = {first.spacing_m[0], first.spacing_m[1], *distance_m};
  stack.grid.directions = Mat3::from_columns(first.row, normal.cross(first.row), normal);
  stack.slices = std::move(slices);
  return stack;
}

}  // namespace orthonav::engine
