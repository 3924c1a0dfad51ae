#include "engine/scan/scan_case.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/joined.h"
#include "engine/scan/level_places.h"
#include "nav/planning/canal.h"

namespace orthonav::engine {
namespace {

/// Volume of the smallest part that is considered, m³: a lumbar vertebra has 40 to 80 cm³.
constexpr double kLeastPart_m3 = 5e-6;

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

Status check_label_places(const Volume& labels, const std::vector<LabelledLevel>& levels,
                          std::string* unusual) {
  std::vector<LevelPlace> places;
  for (const LabelledLevel& level : levels) {
    places.push_back({level.label, middle_m(labels, level)});
  }
  return check_places(places, "is it another convention?", unusual);
}

}  // namespace

Result<ScanLevels> scan_levels(const Volume& labels, const std::string& convention,
                               const std::vector<std::string>& wanted, bool unusual) {
  const auto there = labelled_levels(labels, convention);
  if (!there) {
    return there.error();
  }
  if (Status s = check_wanted(there->levels, wanted); !s) {
    return s.error();
  }
  ScanLevels out;
  out.left_out = there->left_out;
  if (Status s = check_label_places(labels, there->levels, unusual ? &out.unusual : nullptr); !s) {
    return s.error();
  }
  for (const LabelledLevel& labelled : there->levels) {
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
  auto samples = BoneSamples::in(scan);
  if (!samples) {
    return samples.error();
  }
  const auto levels = labelled_levels(labels, convention);
  if (!levels) {
    return levels.error();
  }
  for (const LabelledLevel& level : levels->levels) {
    for_each_voxel(labels, level, [&](const std::array<int, 3>& at) {
      samples->add(labels.grid.place_m(vector_of(at)));
    });
  }
  return samples->check("labels");
}

Case case_of(const ScanLevels& made, const std::string& name) {
  Case out{name, {}, {}, made.unusual};
  for (const ScanLevel& level : made.levels) {
    out.levels.push_back({level.label, level.surface.mesh, {}, {}});
  }
  return out;
}

}  // namespace orthonav::engine
