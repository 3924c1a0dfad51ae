#include "engine/evaluation/level_fit.h"

#include <algorithm>
#include <cmath>

#include "base/angle.h"
#include "base/printed.h"

namespace orthonav::engine {
namespace {

constexpr double kFirst_m = 0.007;  ///< how far along a normal an edge is searched at first
constexpr double kNext_m = 0.0035;  ///< and from a start that is already good

using Poses = std::vector<Transform<Scan, Vertebra>>;

/// How well all levels lie on bone from one start of the spine.
struct Hypothesis {
  double score = 0.0;  ///< sum of the coverages, as far as they lie in the scan
  Poses poses;
};

double score_of(const BoneRegistration& found) { return found.coverage * found.inside_scan; }

Hypothesis tried(const ScanField& scan, const MetalMask& mask, std::span<const LevelSurface> levels,
                 const Transform<Scan, Spine>& start) {
  Hypothesis out;
  for (const LevelSurface& level : levels) {
    const auto pose = start * level.level->spine_from_vertebra;
    const BoneRegistration found = laid_on_bone(scan, mask, level.few, pose, kFirst_m);
    out.score += score_of(found);
    out.poses.push_back(found.scan_from_vertebra);
  }
  return out;
}

bool same_place(const Hypothesis& a, const Hypothesis& b, std::span<const LevelSurface> levels) {
  constexpr double kSame_m = 0.008;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const Point<Vertebra> place{levels[i].few.front().place_m};
    if ((a.poses[i] * place - b.poses[i] * place).norm() < kSame_m) {
      return true;
    }
  }
  return false;
}

/// The best start and its result.
Result<Hypothesis> best_start(const ScanField& scan, const MetalMask& mask,
                              std::span<const LevelSurface> levels,
                              std::span<const Transform<Scan, Spine>> starts) {
  constexpr double kClearlyWorse = 0.90;
  std::vector<Hypothesis> all;
  for (const auto& start : starts) {
    all.push_back(tried(scan, mask, levels, start));
  }
  const auto best = std::max_element(
      all.begin(), all.end(), [](const auto& a, const auto& b) { return a.score < b.score; });
  for (const Hypothesis& other : all) {
    if (other.score > kClearlyWorse * best->score && best->score > 0.0 &&
        !same_place(other, *best, levels)) {
      return Error{
          printed("the spine fits the scan in two places nearly alike (%.2f and %.2f of "
                  "its surface on bone): add a level to the case that tells them apart",
                  best->score / static_cast<double>(levels.size()),
                  other.score / static_cast<double>(levels.size()))};
    }
  }
  return *best;
}

/// Where this level would lie if nothing had moved between it and the other one.
Transform<Scan, Vertebra> seen_from(const LevelSurface& other,
                                    const Transform<Scan, Vertebra>& pose_of_other,
                                    const LevelSurface& level) {
  return pose_of_other * other.level->spine_from_vertebra.inverse() *
         level.level->spine_from_vertebra;
}

void keep_better(const ScanField& scan, const MetalMask& mask, const LevelSurface& level,
                 const Transform<Scan, Vertebra>& start, double within_m, LaidLevel& best) {
  const BoneRegistration rough = laid_on_bone(scan, mask, level.few, start, within_m);
  const BoneRegistration found =
      laid_on_bone(scan, mask, level.many, rough.scan_from_vertebra, kNext_m);
  if (score_of(found) > score_of(best.bone)) {
    best.bone = found;
    best.refusal = refusal(found);
  }
}

/// If an accepted level shows that a refused one lies outside the scan, that becomes the reason.
void say_what_lies_outside(const ScanField& scan, std::span<const LevelSurface> levels,
                           std::vector<LaidLevel>& laid) {
  for (std::size_t i = 0; i < laid.size(); ++i) {
    for (std::size_t other = 0; other < laid.size(); ++other) {
      if (laid[i].refusal.empty() || other == i || !laid[other].refusal.empty()) {
        continue;
      }
      const auto pose = seen_from(levels[other], laid[other].bone.scan_from_vertebra, levels[i]);
      const auto inside = std::count_if(
          levels[i].few.begin(), levels[i].few.end(), [&](const SurfaceSample& sample) {
            return scan.holds((pose * Point<Vertebra>{sample.place_m}).v);
          });
      BoneRegistration there;
      there.inside_scan = static_cast<double>(inside) / static_cast<double>(levels[i].few.size());
      if (there.inside_scan < kLeastInsideScan) {
        laid[i].refusal = refusal(there);
        break;
      }
    }
  }
}

/// How far a level lies from where another one predicts it, per level between them.
struct Step {
  double translation_m = 0.0;
  double rotation_rad = 0.0;
};

Step step_between(std::span<const LevelSurface> levels, const std::vector<LaidLevel>& laid,
                  std::size_t from, std::size_t to) {
  const auto expected = seen_from(levels[from], laid[from].bone.scan_from_vertebra, levels[to]);
  const auto& found = laid[to].bone.scan_from_vertebra;
  const Point<Vertebra> middle{laid[to].bone.uncertainty.centre_m()};
  const double steps = std::abs(static_cast<double>(from) - static_cast<double>(to));
  return {(expected * middle - found * middle).norm() / steps,
          rotation_angle_rad(expected.rotation(), found.rotation()) / steps};
}

/// A vertebra laid on another one's bone fits badly and contradicts its neighbours: of two levels
/// that contradict each other the one that fits worse is refused.
void refuse_displaced(std::span<const LevelSurface> levels, std::vector<LaidLevel>& laid) {
  constexpr double kMostTranslation_m = 0.012;
  constexpr double kMostRotation_rad = 0.35;
  for (std::size_t i = 0; i < laid.size(); ++i) {
    for (std::size_t j = 0; j < laid.size(); ++j) {
      if (i == j || !laid[i].refusal.empty() || !laid[j].refusal.empty() ||
          score_of(laid[i].bone) >= score_of(laid[j].bone)) {
        continue;
      }
      const Step step = step_between(levels, laid, j, i);
      if (step.translation_m > kMostTranslation_m || step.rotation_rad > kMostRotation_rad) {
        laid[i].refusal = printed(
            "it fits best %.0f mm and %.0f° a level from where %s puts it, "
            "limits %.0f mm and %.0f°",
            step.translation_m * 1e3, step.rotation_rad * kDegreesPerRadian,
            levels[j].level->label.c_str(), kMostTranslation_m * 1e3,
            kMostRotation_rad * kDegreesPerRadian);
      }
    }
  }
}

}  // namespace

Result<std::vector<LaidLevel>> laid_levels(const ScanField& scan, const MetalMask& mask,
                                           std::span<const LevelSurface> levels,
                                           std::span<const Transform<Scan, Spine>> starts) {
  const Result<Hypothesis> start = best_start(scan, mask, levels, starts);
  if (!start) {
    return start.error();
  }
  std::vector<LaidLevel> out;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    LaidLevel level{laid_on_bone(scan, mask, levels[i].many, start->poses[i], kNext_m), ""};
    level.refusal = refusal(level.bone);
    out.push_back(std::move(level));
  }
  for (std::size_t i = 0; i < levels.size(); ++i) {
    for (std::size_t other = 0; other < levels.size(); ++other) {
      if (!out[i].refusal.empty() && other != i && out[other].refusal.empty()) {
        keep_better(scan, mask, levels[i],
                    seen_from(levels[other], out[other].bone.scan_from_vertebra, levels[i]),
                    kFirst_m, out[i]);
      }
    }
  }
  refuse_displaced(levels, out);
  say_what_lies_outside(scan, levels, out);
  return out;
}

}  // namespace orthonav::engine
