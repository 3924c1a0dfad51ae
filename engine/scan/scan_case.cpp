#include "engine/scan/scan_case.h"

#include <algorithm>
#include <cmath>

#include "base/joined.h"
#include "base/printed.h"
#include "nav/planning/canal.h"

namespace orthonav::engine {
namespace {

/// Cubic metres of the least part that is looked at: a lumbar vertebra has 40 to 80 cm3.
constexpr double kLeastPart_m3 = 5e-6;
constexpr double kMostOutside = 0.1;
constexpr double kLeastBone_hu = 50.0;

/// What is made where nothing is asked for: a sacrum and the upper neck are no bones to put pedicle
/// screws into by these rules.
bool made_unasked(const std::string& label) { return label[0] == 'T' || label[0] == 'L'; }

enum class Cut { kRefused, kClosed };

/// `cut`: what becomes of a label that goes on beyond the border of the scan.
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

/// The middle of a label, in the scan's frame.
Vec3 middle_m(const Volume& labels, const LabelledLevel& level) {
  Vec3 sum;
  double count = 0.0;
  for (int k = 0; k < labels.grid.size[2]; ++k) {
    for (int j = 0; j < labels.grid.size[1]; ++j) {
      for (int i = 0; i < labels.grid.size[0]; ++i) {
        if (labels.values[labels.grid.at(i, j, k) * labels.layers + level.layer] ==
            static_cast<float>(level.value)) {
          sum += Vec3{double(i), double(j), double(k)};
          count += 1.0;
        }
      }
    }
  }
  return labels.grid.place_m(sum / std::max(count, 1.0));
}

/// What gives away numbers that are read by another convention than they were written by: vertebrae
/// out of their order, or nearer together or farther apart than those of these names are.
Status check_places(const Volume& labels, const std::vector<LabelledLevel>& levels) {
  constexpr double kLeastRatio = 0.72, kMostRatio = 1.35;
  double measured_m = 0.0, usual_m = 0.0;
  for (std::size_t i = 1; i < levels.size(); ++i) {
    const Vec3 down = middle_m(labels, levels[i]) - middle_m(labels, levels[i - 1]);
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
  for (const Status& s : {check_places(labels, *there), check_wanted(*there, wanted)}) {
    if (!s) {
      return s.error();
    }
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

Status check_on_bone(const Volume& labels, const Volume& scan) {
  double sum_hu = 0.0;
  std::size_t inside = 0, all = 0;
  for (int k = 0; k < labels.grid.size[2]; ++k) {
    for (int j = 0; j < labels.grid.size[1]; ++j) {
      for (int i = 0; i < labels.grid.size[0]; ++i) {
        if (!(labels.values[labels.grid.at(i, j, k) * labels.layers] > 0.0F)) {
          continue;
        }
        ++all;
        const Vec3 at = scan.grid.index_of(labels.grid.place_m({double(i), double(j), double(k)}));
        const long x = std::lround(at.x), y = std::lround(at.y), z = std::lround(at.z);
        if (x < 0 || y < 0 || z < 0 || x >= scan.grid.size[0] || y >= scan.grid.size[1] ||
            z >= scan.grid.size[2]) {
          continue;
        }
        ++inside;
        sum_hu += static_cast<double>(scan.values[scan.grid.at(
            static_cast<int>(x), static_cast<int>(y), static_cast<int>(z))]);
      }
    }
  }
  const double outside = all > 0 ? 1.0 - static_cast<double>(inside) / static_cast<double>(all) : 1;
  constexpr const char* kHint =
      "; are their axes mixed up (LPS, RAS), or are they of another scan?";
  if (outside > kMostOutside) {
    return Error{printed("%.0f %% of the labels lie outside of the scan, limit %.0f %%",
                         outside * 1e2, kMostOutside * 1e2) +
                 kHint};
  }
  const double mean_hu = sum_hu / static_cast<double>(std::max<std::size_t>(inside, 1));
  if (mean_hu < kLeastBone_hu) {
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
