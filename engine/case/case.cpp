#include "engine/case/case.h"

#include <algorithm>
#include <optional>

#include "base/length_text.h"
#include "engine/case/operation.h"
#include "engine/case/screw_place.h"
#include "engine/io/inside_folder.h"

namespace orthonav::engine {
namespace {

/// Centres of neighbouring lumbar vertebrae lie 30 mm and more apart; closer ones intersect.
constexpr double kMinLevelSpacing_m = 0.015;
/// From one end of the spine to the other.
constexpr double kMaxLevelSpacing_m = 1.0;

std::optional<std::string> screw_problem(const nav::SurfaceIndex& bone,
                                         const nav::TriangleMesh& mesh,
                                         const nav::ScrewPlan& screw) {
  const std::string which = name_of(screw.side);
  if (const auto problem = misplaced(bone, screw.entry, screw.target, screw.radius_m)) {
    return which + " " + *problem;
  }
  const OffMidline off = off_midline(mesh, screw.entry, screw.target);
  if (off.side().value_or(screw.side) != screw.side) {
    return which + " entry lies " + to_the_side(off.entry_m) +
           " of the bone's middle, must lie to the " + which;
  }
  return std::nullopt;
}

}  // namespace

Point<Spine> CaseLevel::centre_in_spine() const {
  return spine_from_vertebra * Point<Vertebra>{nav::bounds_of(mesh).centre()};
}

const CaseLevel* Case::find(const std::string& label) const {
  const auto found = std::find_if(levels.begin(), levels.end(),
                                  [&](const CaseLevel& level) { return level.label == label; });
  return found == levels.end() ? nullptr : &*found;
}

const CaseLevel* Case::overlapped_by(std::size_t index) const {
  const Point<Spine> centre = levels[index].centre_in_spine();
  for (std::size_t i = 0; i < index; ++i) {
    if ((levels[i].centre_in_spine() - centre).norm() < kMinLevelSpacing_m) {
      return &levels[i];
    }
  }
  return nullptr;
}

std::vector<std::string> Case::check(CaseUse use) const {
  std::vector<std::string> problems;
  const bool bare = std::all_of(levels.begin(), levels.end(),
                                [](const CaseLevel& level) { return level.screws.empty(); });
  if (levels.empty() && use != CaseUse::kRods) {
    problems.push_back(
        "levels is empty, at least 1 needed, unless rods alone are bent (orthonav run "
        "--rods-only)");
  } else if (use == CaseUse::kOperation && bare) {
    problems.push_back("no level has screws (orthonav plan auto places them)");
  }
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const CaseLevel& level = levels[i];
    const std::string which =
        level.label.empty() ? "levels[" + std::to_string(i) + "]" : level.label;
    if (level.label.empty()) {
      problems.push_back(which + " has no label");
    } else if (!is_part_of_a_file_name(level.label)) {
      // Files are named after the label.
      problems.push_back("label \"" + level.label +
                         "\" must have 64 characters at most, no / and no . in front");
    }
    if (!level.label.empty() && find(level.label) != &level) {
      problems.push_back("label " + level.label + " stands twice");
    }
    if (const CaseLevel* other = overlapped_by(i)) {
      problems.push_back(which + " lies in " + other->label + " (see spine_from_model)");
    }
    const double far_m = (level.centre_in_spine() - levels.front().centre_in_spine()).norm();
    if (far_m > kMaxLevelSpacing_m) {
      problems.push_back(which + " lies " + in_mm(far_m) + " from " + levels.front().label +
                         ", limit " + in_mm(kMaxLevelSpacing_m) +
                         ": is the unit of spine_from_model (case.json, units) another one?");
    }
    if (level.mesh.triangles.empty()) {
      problems.push_back(which + " has no surface");
      continue;
    }
    const nav::SurfaceIndex bone(level.mesh);
    for (const nav::ScrewPlan& screw : level.screws) {
      if (const auto problem = screw_problem(bone, level.mesh, screw)) {
        problems.push_back(which + " " + *problem);
      }
    }
  }
  return problems;
}

void add(BitHash& hash, const nav::TriangleMesh& mesh) {
  for (const Vec3 vertex_m : mesh.vertices_m) {
    hash.add(vertex_m);
  }
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) {
      hash.add(static_cast<std::uint64_t>(corner));
    }
  }
}

}  // namespace orthonav::engine
