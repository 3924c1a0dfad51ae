#include "engine/evaluation/evaluation.h"

#include <algorithm>

#include "engine/evaluation/level_fit.h"
#include "engine/evaluation/placed_screw.h"
#include "engine/evaluation/shaft_fit.h"
#include "engine/evaluation/spine_start.h"
#include "engine/evaluation/tip_fit.h"

namespace orthonav::engine {
namespace {

constexpr std::size_t kFewSamples = 350;
constexpr std::size_t kManySamples = 2500;
constexpr std::size_t kMaxStarts = 7;
constexpr double kMaskMargin_m = 0.002;

/// Each shaft to a fraction of a voxel; one whose fit fails becomes unassigned metal.
std::vector<Shaft> fitted(const ScanField& scan, const MetalPieces& metal,
                          std::vector<UnassignedMetal>& unassigned) {
  std::vector<Shaft> out;
  for (std::size_t i = 0; i < metal.shafts.size(); ++i) {
    std::vector<Shaft> others = metal.shafts;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    Shaft shaft = metal.shafts[i];
    shaft.cut = !scan.holds(shaft.line.at(shaft.to_s_m + 0.0015));
    if (auto exact = fitted_shaft(scan, shaft, others)) {
      out.push_back(*exact);
    } else {
      unassigned.push_back({shaft.tip(), std::nullopt, 0.0, ""});
    }
  }
  fit_touching_tips(scan, out);
  for (const OtherMetal& other : metal.others) {
    unassigned.push_back({other.centre, std::nullopt, other.volume_m3, ""});
  }
  return out;
}

std::vector<LevelSurface> planned_surfaces(const Case& subject) {
  std::vector<LevelSurface> out;
  for (const CaseLevel& level : subject.levels) {
    if (!level.screws.empty()) {
      out.push_back({&level, surface_samples(level.mesh, kFewSamples),
                     surface_samples(level.mesh, kManySamples)});
    }
  }
  return out;
}

/// A shaft that may be a planned screw.
struct Candidate {
  std::size_t level = 0;
  std::size_t screw = 0;
  std::size_t shaft = 0;
  nav::ScrewCylinder cylinder;
  double distance_m = 0.0;
};

using Bones = std::vector<std::optional<nav::SurfaceIndex>>;

std::vector<Candidate> candidates(const Evaluation& found, const Bones& bones) {
  std::vector<Candidate> out;
  for (std::size_t l = 0; l < found.levels.size(); ++l) {
    const EvaluatedLevel& level = found.levels[l];
    for (std::size_t s = 0; level.registration && s < level.screws.size(); ++s) {
      for (std::size_t i = 0; i < found.shafts.size(); ++i) {
        const auto cylinder = cylinder_in_bone(found.shafts[i], level.screws[s].plan,
                                               {*bones[l], *level.registration});
        if (cylinder) {
          out.push_back(
              {l, s, i, *cylinder, distance_from_plan_m(*cylinder, level.screws[s].plan)});
        }
      }
    }
  }
  std::stable_sort(out.begin(), out.end(), [](const Candidate& a, const Candidate& b) {
    return a.distance_m < b.distance_m;
  });
  return out;
}

/// Nearest first; every shaft is one screw at most.
std::vector<bool> assign(const Bones& bones, Evaluation& out) {
  std::vector<bool> used(out.shafts.size());
  for (const Candidate& candidate : candidates(out, bones)) {
    EvaluatedLevel& level = out.levels[candidate.level];
    EvaluatedScrew& screw = level.screws[candidate.screw];
    if (!screw.placed && !used[candidate.shaft]) {
      screw.placed = placed_screw(out.shafts[candidate.shaft], screw.plan, candidate.cylinder,
                                  {*bones[candidate.level], *level.registration});
      screw.placed->shaft = candidate.shaft;
      used[candidate.shaft] = true;
    }
  }
  return used;
}

/// Which vertebra a place lies in.
std::string where_is(Point<Scan> place, const Evaluation& found, const Bones& bones) {
  bool all = true;
  for (std::size_t l = 0; l < found.levels.size(); ++l) {
    const EvaluatedLevel& level = found.levels[l];
    all = all && level.registration;
    if (level.registration &&
        bones[l]->contains((level.registration->scan_from_vertebra.inverse() * place).v)) {
      return "in " + level.label;
    }
  }
  return all ? "outside the planned vertebrae" : "place unknown";
}

/// The levels in the order of the case, with the registrations that were accepted.
std::vector<EvaluatedLevel> levels_of(const std::vector<LevelSurface>& surfaces,
                                      const std::vector<LaidLevel>& laid) {
  std::vector<EvaluatedLevel> out;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    EvaluatedLevel level{surfaces[i].level->label, {}, laid[i].refusal, {}};
    if (level.refusal.empty()) {
      level.registration = laid[i].bone;
    }
    for (const nav::ScrewPlan& plan : surfaces[i].level->screws) {
      level.screws.push_back({plan, std::nullopt});
    }
    out.push_back(std::move(level));
  }
  return out;
}

void report_unassigned(const std::vector<bool>& used, const Bones& bones, Evaluation& out) {
  for (std::size_t i = 0; i < out.shafts.size(); ++i) {
    if (!used[i]) {
      out.unassigned.push_back({out.shafts[i].tip(), i, 0.0, ""});
    }
  }
  for (UnassignedMetal& metal : out.unassigned) {
    metal.where = where_is(metal.place, out, bones);
  }
}

}  // namespace

Result<Evaluation> evaluate(const Case& subject, const Volume& volume) {
  if (Status s = check_scan(volume); !s) {
    return s.error();
  }
  const std::vector<LevelSurface> surfaces = planned_surfaces(subject);
  if (surfaces.empty()) {
    return Error{"the case has no planned screw"};
  }
  const ScanField scan(volume);
  const MetalMask mask(scan, kMaskMargin_m);
  Evaluation out;
  const Vec3 spacing_m = volume.grid.spacing_m;
  out.slices_m = std::max({spacing_m.x, spacing_m.y, spacing_m.z});
  out.shafts = fitted(scan, straight_metal(scan), out.unassigned);
  const auto laid =
      laid_levels(scan, mask, surfaces, spine_starts(subject, out.shafts, kMaxStarts));
  if (!laid) {
    return laid.error();
  }
  out.levels = levels_of(surfaces, *laid);
  Bones bones;
  for (const LevelSurface& surface : surfaces) {
    bones.emplace_back(surface.level->mesh);
  }
  const std::vector<bool> used = assign(bones, out);
  report_unassigned(used, bones, out);
  return out;
}

}  // namespace orthonav::engine
