#include "engine/scan/scan_case.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/joined.h"
#include "base/printed.h"
#include "nav/planning/canal.h"

namespace orthonav::engine {
namespace {

/// Volume of the smallest part that is considered, m³: a lumbar vertebra has 40 to 80 cm³.
constexpr double kLeastPart_m3 = 5e-6;
constexpr double kMostOutside = 0.1;
constexpr double kLeastBone_hu = 50.0;

/// Without `--levels` only T and L are made: these rules are not for the neck or the sacrum.
bool made_unasked(const std::string& label) { return label[0] == 'T' || label[0] == 'L'; }

enum class Cut { kRefused, kClosed };

/// `cut`: what to do with a label that is cut by the border of the scan.
Result<ScanLevel> level_of(const Volume& labels, const LabelledLevel& labelled, Cut cut) {
  const auto part = label_part(labels, labelled, kSurfaceMargin);
  if (!part) {
    return part.error();
  }
  if (part->at_border > 0 && cut == Cut::kRefused) {
    return Error{labelled.label +
                 " is cut by the border of the scan: " + std::to_string(part->at_border) +
                 " of its " + std::to_string(part->voxels) + " voxels lie there"};
  }
  auto surface = label_surface(*part);
  if (!surface) {
    return Error{labelled.label + ": " + surface.error().message};
  }
  const bool canal = nav::find_canal(surface->mesh, nav::SurfaceIndex(surface->mesh)).has_value();
  return ScanLevel{labelled.label, std::move(*surface), part->voxels, part->dropped, canal};
}

Status check_wanted(const std::vector<LabelledLevel>& there,
                    const std::vector<std::string>& wanted) {
  std::vector<std::string> names;
  for (const LabelledLevel& level : there) {
    names.push_back(level.label);
  }
  for (const std::string& label : wanted) {
    if (std::find(names.begin(), names.end(), label) == names.end()) {
      return Error{"holds no " + label + " (it has: " + joined(names, ", ") + ")"};
    }
  }
  return {};
}

Vec3 vector_of(const std::array<int, 3>& index) {
  return {double(index[0]), double(index[1]), double(index[2])};
}

/// The middle of a label, in the scan's frame.
Vec3 middle_m(const Volume& labels, const LabelledLevel& level) {
  Vec3 sum;
  double count = 0.0;
  for_each_voxel(labels, level, [&](const std::array<int, 3>& at) {
    sum += vector_of(at);
    count += 1.0;
  });
  return labels.grid.place_m(sum / std::max(count, 1.0));
}

/// Signs that the numbers were read by the wrong convention: vertebrae out of order, or too near
/// together or too far apart for their names.
Status check_places(const Volume& labels, const std::vector<LabelledLevel>& levels) {
  constexpr double kLeastRatio = 0.72, kMostRatio = 1.35;
  std::vector<Vec3> middles_m;
  for (const LabelledLevel& level : levels) {
    middles_m.push_back(middle_m(labels, level));
  }
  double measured_m = 0.0, usual_m = 0.0;
  for (std::size_t i = 1; i < levels.size(); ++i) {
    const Vec3 down = middles_m[i] - middles_m[i - 1];
    if (!(down.z < 0.0)) {
      return Error{levels[i].label + " lies above " + levels[i - 1].label +
                   ": is it another convention?"};
    }
    measured_m += down.norm();
    usual_m += usual_distance_m(levels[i - 1].label, levels[i].label);
  }
  if (levels.size() < 2) {
    return {};
  }
  const double ratio = measured_m / usual_m;
  if (ratio < kLeastRatio || ratio > kMostRatio) {
    return Error{printed("%s to %s measure %.0f mm, usual are %.0f mm: is it another convention?",
                         levels.front().label.c_str(), levels.back().label.c_str(),
                         measured_m * 1e3, usual_m * 1e3)};
  }
  return {};
}

}  // namespace

Result<ScanLevels> scan_levels(const Volume& labels, const std::string& convention,
                               const std::vector<std::string>& wanted) {
  const auto there = labelled_levels(labels, convention);
  if (!there) {
    return there.error();
  }
  if (Status s = check_wanted(*there, wanted); !s) {
    return s.error();
  }
  if (Status s = check_places(labels, *there); !s) {
    return s.error();
  }
  ScanLevels out;
  for (const LabelledLevel& labelled : *there) {
    const bool asked = std::find(wanted.begin(), wanted.end(), labelled.label) != wanted.end();
    if (!asked && (!wanted.empty() || !made_unasked(labelled.label))) {
      continue;
    }
    auto level = level_of(labels, labelled, Cut::kRefused);
    if (!level && asked) {
      return level.error();
    }
    if (!level) {
      out.left_out.push_back(level.error().message);
      continue;
    }
    out.levels.push_back(std::move(*level));
  }
  if (out.levels.empty()) {
    return Error{"holds no whole vertebra from T1 to L6" +
                 (out.left_out.empty() ? "" : ": " + joined(out.left_out))};
  }
  return out;
}

Result<ScanLevels> threshold_levels(const Volume& scan, double threshold_hu) {
  const auto parts = dense_parts(scan, threshold_hu, kLeastPart_m3);
  if (!parts) {
    return parts.error();
  }
  const float count = *std::max_element(parts->values.begin(), parts->values.end());
  ScanLevels out;
  for (int i = 1; static_cast<float>(i) <= count; ++i) {
    auto level = level_of(*parts, {"part" + std::to_string(i), 0, i}, Cut::kClosed);
    if (level) {
      out.levels.push_back(std::move(*level));
    } else {
      out.left_out.push_back(level.error().message);
    }
  }
  if (out.levels.empty()) {
    return Error{"no dense part is a vertebra by its size: " + joined(out.left_out)};
  }
  return out;
}

Status check_on_bone(const Volume& labels, const std::string& convention, const Volume& scan) {
  if (scan.layers != 1) {
    return Error{"the scan has " + std::to_string(scan.layers) + " values a voxel, a CT has 1"};
  }
  const auto levels = labelled_levels(labels, convention);
  if (!levels) {
    return levels.error();
  }
  double sum_hu = 0.0;
  std::size_t inside = 0, all = 0;
  for (const LabelledLevel& level : *levels) {
    for_each_voxel(labels, level, [&](const std::array<int, 3>& at) {
      ++all;
      if (const auto voxel = scan.grid.voxel_around(labels.grid.place_m(vector_of(at)))) {
        ++inside;
        sum_hu += static_cast<double>(scan.values[*voxel]);
      }
    });
  }
  constexpr const char* kHint =
      "; are their axes mixed up (LPS, RAS), or are they of another scan?";
  const double outside =
      1.0 - static_cast<double>(inside) / static_cast<double>(std::max<std::size_t>(all, 1));
  if (!(outside <= kMostOutside)) {
    return Error{printed("%.0f %% of the labels lie outside of the scan, limit %.0f %%",
                         outside * 1e2, kMostOutside * 1e2) +
                 kHint};
  }
  const double mean_hu = sum_hu / static_cast<double>(inside);
  if (!(mean_hu >= kLeastBone_hu)) {
    return Error{
        printed("the scan has %.0f HU on average where the labels are, bone has %.0f or more",
                mean_hu, kLeastBone_hu) +
        kHint};
  }
  return {};
}

Case case_of(const ScanLevels& made, const std::string& name) {
  Case out{name, {}, {}};
  for (const ScanLevel& level : made.levels) {
    out.levels.push_back({level.label, level.surface.mesh, {}, {}});
  }
  return out;
}

}  // namespace orthonav::engine
