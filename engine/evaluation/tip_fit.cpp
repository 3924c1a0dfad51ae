#include "engine/evaluation/tip_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/evaluation/every_nth.h"
#include "engine/evaluation/shaft_model.h"

namespace orthonav::engine {
namespace {

constexpr double kReach_m = 0.020;        ///< the search is wrong by no more
constexpr double kFineReach_m = 0.004;    ///< the tips on the grid are wrong by far less
constexpr double kLeastLength_m = 0.008;  ///< of a shaft
constexpr double kCoarseStep_m = 0.001;

/// The tips of two shafts, along their own axes.
struct Tips {
  double first_s_m = 0.0;
  double second_s_m = 0.0;
};

/// The misfit of the voxels about two tips as a function of where these are.
class TipMisfit {
 public:
  /// For tips within `reach_m` of the shafts' present ones.
  TipMisfit(const ScanField& scan, const Shaft& first, const Shaft& second,
            const std::vector<Shaft>& others, double reach_m) {
    std::vector<BorderVoxel> voxels = border_voxels(scan, zone_of(first, reach_m), others);
    model_ = shaft_model(scan, voxels, first);
    // What lies about both counts twice, once for each.
    const std::vector<BorderVoxel> more = border_voxels(scan, zone_of(second, reach_m), others);
    voxels.insert(voxels.end(), more.begin(), more.end());
    constexpr std::size_t kMost = 2500;
    voxels = every_nth<BorderVoxel>(voxels, voxels.size() / kMost + 1);
    for (const BorderVoxel& voxel : voxels) {
      hu_.push_back(voxel.hu);
      for (const Vec3& part : model_.places_m) {
        samples_.push_back({of(first, voxel.place_m + part), of(second, voxel.place_m + part)});
      }
    }
  }

  [[nodiscard]] double at(const Tips& tips) const {
    const std::size_t parts = model_.places_m.size();
    double sum = 0.0;
    for (std::size_t v = 0; v < hu_.size(); ++v) {
      double fraction = 0.0;
      for (std::size_t n = v * parts; n < (v + 1) * parts; ++n) {
        const auto& [a, b] = samples_[n];
        fraction += 1.0 - (1.0 - metal(a, tips.first_s_m)) * (1.0 - metal(b, tips.second_s_m));
      }
      const double misfit = model_.misfit(hu_[v], fraction / static_cast<double>(parts));
      sum += misfit * misfit;
    }
    return sum;
  }

 private:
  /// A place as one shaft sees it.
  struct Place {
    double across = 0.0;  ///< its share of metal if the shaft had no end
    double s_m = 0.0;
  };
  struct Sample {
    Place first;
    Place second;
  };
  static Place of(const Shaft& shaft, Vec3 place_m) {
    return {share_across(shaft.radius_m, shaft.line.off_m(place_m), kUsualBlur_m),
            shaft.line.s_of(place_m)};
  }
  static double metal(const Place& place, double tip_s_m) {
    return place.across < 1e-3 ? 0.0
                               : place.across * share_before_end(tip_s_m - place.s_m, kUsualBlur_m);
  }
  /// The part of a shaft where its tip may be, clear of its head.
  static Shaft zone_of(const Shaft& shaft, double reach_m) {
    Shaft out = shaft;
    out.from_s_m = std::max(shaft.from_s_m + 0.5 * kLeastLength_m, shaft.to_s_m - reach_m - 0.002);
    out.to_s_m = shaft.to_s_m + reach_m;
    out.goes_on = true;
    return out;
  }

  ShaftModel model_;
  std::vector<double> hu_;
  std::vector<Sample> samples_;
};

/// Steps downhill with smaller and smaller steps.
Tips descended(const TipMisfit& misfit, Tips tips) {
  constexpr double kLast_m = 0.00002;
  double best = misfit.at(tips);
  for (double step = 0.5 * kCoarseStep_m; step > kLast_m; step *= 0.5) {
    for (bool again = true; again;) {
      again = false;
      for (const auto& [a, b] : {std::pair{step, 0.0}, {-step, 0.0}, {0.0, step}, {0.0, -step}}) {
        const Tips there{tips.first_s_m + a, tips.second_s_m + b};
        const double value = misfit.at(there);
        if (value < best) {
          best = value;
          tips = there;
          again = true;
        }
      }
    }
  }
  return tips;
}

/// The places where a tip may lie, 1 mm apart.
std::vector<double> places_of_tip(const Shaft& shaft) {
  std::vector<double> out;
  for (double s = shaft.to_s_m - kReach_m; s <= shaft.to_s_m + kReach_m; s += kCoarseStep_m) {
    if (s >= shaft.from_s_m + kLeastLength_m) {
      out.push_back(s);
    }
  }
  return out;
}

/// Whether these two may touch: their axes pass one another closely where the tips may be.
bool may_touch(const Shaft& first, const Shaft& second) {
  Shaft a = first;
  Shaft b = second;
  b.to_s_m += kReach_m;
  const std::vector<double> places = places_of_tip(first);
  return std::any_of(places.begin(), places.end(), [&](double s_m) {
    a.to_s_m = s_m;
    return tip_touches(a, b);
  });
}

/// The best tips on a grid.
Tips roughly_best(const TipMisfit& misfit, const Shaft& first, const Shaft& second) {
  Tips best{first.to_s_m, second.to_s_m};
  double least = misfit.at(best);
  for (const double first_s_m : places_of_tip(first)) {
    for (const double second_s_m : places_of_tip(second)) {
      const Tips there{first_s_m, second_s_m};
      const double value = misfit.at(there);
      if (value < least) {
        least = value;
        best = there;
      }
    }
  }
  return best;
}

/// Whether moving one tip explains the voxels nearly as well, wherever the other one then is.
bool explains_too(const TipMisfit& misfit, const Tips& best, double Tips::*moved, double by_m) {
  constexpr double kClearlyWorse = 50.0;  ///< SD²; a tip in sight makes hundreds in a millimetre
  constexpr double kOther_m = 0.003;
  constexpr double kOtherStep_m = 0.0005;
  double Tips::*const other = moved == &Tips::first_s_m ? &Tips::second_s_m : &Tips::first_s_m;
  const double limit = misfit.at(best) + kClearlyWorse;
  for (double off = -kOther_m; off <= kOther_m; off += kOtherStep_m) {
    Tips there = best;
    there.*moved += by_m;
    there.*other += off;
    if (misfit.at(there) < limit) {
      return true;
    }
  }
  return false;
}

/// Sets a shaft's tip; if it is not seen, to the place up to which the shaft is surely metal.
void end_at(const TipMisfit& misfit, const Tips& best, double Tips::*tip, Shaft& shaft) {
  constexpr double kSeen_m = 0.001;
  shaft.to_s_m = best.*tip;
  if (!explains_too(misfit, best, tip, kSeen_m) && !explains_too(misfit, best, tip, -kSeen_m)) {
    return;
  }
  shaft.tip_seen = false;
  double back_m = 0.0;
  while (back_m < kFineReach_m && explains_too(misfit, best, tip, -back_m - kSeen_m)) {
    back_m += kSeen_m;
  }
  shaft.to_s_m -= back_m;
}

void fit_pair(const ScanField& scan, const std::vector<Shaft>& others, Shaft& a, Shaft& b) {
  const Tips rough = roughly_best({scan, a, b, others, kReach_m}, a, b);
  a.to_s_m = rough.first_s_m;
  b.to_s_m = rough.second_s_m;
  const TipMisfit misfit(scan, a, b, others, kFineReach_m);
  const Tips best = descended(misfit, rough);
  end_at(misfit, best, &Tips::first_s_m, a);
  end_at(misfit, best, &Tips::second_s_m, b);
}

/// The share of the ring beside a shaft that is denser than bone, clear of the metal's own blur.
double dense_share(const ScanField& scan, const Shaft& shaft, double from_s_m, double to_s_m) {
  constexpr double kCement_hu = 1800.0;  ///< cortical bone is below
  constexpr double kEvery_m = 0.001;
  constexpr int kAngles = 12;
  int all = 0, dense = 0;
  for (double s = from_s_m; s <= to_s_m; s += kEvery_m) {
    for (const double beside_m : {0.0015, 0.0025}) {
      for (int i = 0; i < kAngles; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kAngles;
        const Vec3 around =
            std::cos(angle) * shaft.line.across + std::sin(angle) * shaft.line.athwart;
        const double hu = scan.at(shaft.line.at(s) + (shaft.radius_m + beside_m) * around);
        all += std::isfinite(hu) ? 1 : 0;
        dense += hu >= kCement_hu ? 1 : 0;
      }
    }
  }
  return all == 0 ? 0.0 : static_cast<double>(dense) / all;
}

/// Whether the shaft ends in cement, in which its end cannot be told, or where cement begins.
bool ends_in_cement(const ScanField& scan, const Shaft& shaft) {
  constexpr double kDense = 0.25;  ///< streaks are thinner
  constexpr double kAround_m = 0.008;
  return dense_share(scan, shaft, shaft.to_s_m - kAround_m, shaft.to_s_m) > kDense ||
         dense_share(scan, shaft, shaft.to_s_m, shaft.to_s_m + kAround_m) > kDense;
}

std::vector<Shaft> all_but(const std::vector<Shaft>& shafts, std::size_t i, std::size_t j) {
  std::vector<Shaft> out;
  for (std::size_t k = 0; k < shafts.size(); ++k) {
    if (k != i && k != j) {
      out.push_back(shafts[k]);
    }
  }
  return out;
}

}  // namespace

void fit_touching_tips(const ScanField& scan, std::vector<Shaft>& shafts) {
  for (std::size_t i = 0; i < shafts.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!shafts[i].cut && !shafts[j].cut && may_touch(shafts[i], shafts[j])) {
        fit_pair(scan, all_but(shafts, i, j), shafts[i], shafts[j]);
      }
    }
  }
  for (Shaft& shaft : shafts) {
    for (const Shaft& other : shafts) {
      if (&other != &shaft && (tip_touches(shaft, other) || tip_touches(other, shaft))) {
        shaft.touched = true;
        shaft.tip_seen = shaft.tip_seen && !other.cut;
      }
    }
    shaft.tip_seen =
        shaft.tip_seen && !shaft.cut && (shaft.touched || !ends_in_cement(scan, shaft));
  }
}

}  // namespace orthonav::engine
