#include "tests/support/stroke_coverage.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace orthonav::test {
namespace {

constexpr double kFinestPitch_m = 0.0015;
constexpr double kWidestPitch_m = 0.0060;

/// Cuts a stroke into the parts that are actually stroked.
using Cut = std::function<std::vector<Walk>(const Walk&)>;

std::vector<BoneRegion> every_region() {
  std::vector<BoneRegion> all;
  for (int r = 0; r < kBoneRegions; ++r) {
    all.push_back(static_cast<BoneRegion>(r));
  }
  return all;
}

double length_m(const std::vector<Walk>& walks) {
  double sum_m = 0.0;
  for (const Walk& walk : walks) {
    sum_m += walk.length_m();
  }
  return sum_m;
}

std::vector<Walk> walks_over(const TouchableBone& bone, const PosteriorLandmarks& marks,
                             const std::vector<BoneRegion>& regions, double pitch_m,
                             const Random& random, const Cut& cut) {
  std::vector<Walk> walks;
  for (const BoneRegion region : regions) {
    Random stream = random.fork(static_cast<std::uint64_t>(region));
    for (const Lane& lane : lanes_over(region, marks, pitch_m, stream)) {
      for (const Walk& walk : bone.walk(lane)) {
        for (Walk& part : cut ? cut(walk) : std::vector<Walk>{walk}) {
          walks.push_back(std::move(part));
        }
      }
    }
  }
  return walks;
}

/// The length for a first pitch determines the pitch for the wanted length. If even the finest
/// pitch gives too little, the surgeon strokes the bone again.
std::vector<Walk> walks_of_length(const TouchableBone& bone, const PosteriorLandmarks& marks,
                                  const std::vector<BoneRegion>& regions, double wanted_m,
                                  const Random& random, const Cut& cut = {}) {
  constexpr double kFirstPitch_m = 0.003;
  constexpr double kEnough = 0.8;
  constexpr std::uint64_t kMaxPasses = 5;
  const double got_m = length_m(walks_over(bone, marks, regions, kFirstPitch_m, random, cut));
  const double pitch_m =
      std::clamp(kFirstPitch_m * got_m / wanted_m, kFinestPitch_m, kWidestPitch_m);
  std::vector<Walk> walks;
  for (std::uint64_t pass = 0; pass < kMaxPasses && length_m(walks) < kEnough * wanted_m; ++pass) {
    for (Walk& walk : walks_over(bone, marks, regions, pitch_m, random.fork(pass), cut)) {
      walks.push_back(std::move(walk));
    }
  }
  return walks;
}

/// Leaves out what lies on one side of the midline and above (or below) a height.
Cut without(int side, double midline_x_m, double height_m, bool above) {
  return [=](const Walk& walk) {
    std::vector<Walk> kept;
    Walk run{walk.region, {}, {}};
    const auto end = [&] {
      constexpr double kShortest_m = 0.004;
      if (!run.arc_m.empty()) {
        const double start_m = run.arc_m.front();
        for (double& s : run.arc_m) {
          s -= start_m;
        }
      }
      if (run.length_m() >= kShortest_m) {
        kept.push_back(run);
      }
      run = {walk.region, {}, {}};
    };
    for (std::size_t i = 0; i < walk.touches.size(); ++i) {
      const Vec3 at = walk.touches[i].surface_m;
      const bool dropped =
          side * (at.x - midline_x_m) > 0.0 && (above ? at.z > height_m : at.z < height_m);
      if (dropped) {
        end();
        continue;
      }
      run.touches.push_back(walk.touches[i]);
      run.arc_m.push_back(walk.arc_m[i]);
    }
    end();
    return kept;
  };
}

BoneRegion on_side(BoneRegion left, bool right) {
  return static_cast<BoneRegion>(static_cast<int>(left) + (right ? 1 : 0));
}

struct Part {
  std::vector<BoneRegion> regions;
  Cut cut;
  std::string words;
};

/// Leaves out a third of what is touched on one side, by height.
Cut third_off(const TouchableBone& bone, const PosteriorLandmarks& marks, int side, bool above,
              const Random& random) {
  double low_m = std::numeric_limits<double>::infinity();
  double high_m = -low_m;
  for (const Walk& walk : walks_over(bone, marks, every_region(), kWidestPitch_m, random, {})) {
    for (const Touch& touch : walk.touches) {
      if (side * (touch.surface_m.x - marks.midline_x_m) <= 0.0) {
        continue;
      }
      low_m = std::min(low_m, touch.surface_m.z);
      high_m = std::max(high_m, touch.surface_m.z);
    }
  }
  const double third_m = (high_m - low_m) / 3.0;
  return without(side, marks.midline_x_m, above ? high_m - third_m : low_m + third_m, above);
}

Part drawn_part(const TouchableBone& bone, const PosteriorLandmarks& marks, Random& random) {
  const auto kind = static_cast<int>(random.uniform(0.0, 4.0));
  const bool right = random.uniform() < 0.5;
  const bool second = random.uniform() < 0.5;
  const std::string side = right ? "right" : "left";
  const auto lamina = on_side(BoneRegion::kLeftLamina, right);
  const auto facet = on_side(BoneRegion::kLeftFacet, right);
  const auto root = on_side(BoneRegion::kLeftTransverseRoot, right);
  const std::vector<BoneRegion> spinous{BoneRegion::kLeftSpinousSide, BoneRegion::kRightSpinousSide,
                                        BoneRegion::kCrest};
  switch (kind) {
    case 0:
      return {
          {lamina, facet, root, on_side(BoneRegion::kLeftSpinousSide, right), BoneRegion::kCrest},
          {},
          side + " side and spinous process"};
    case 1:
      return {{BoneRegion::kLeftLamina, BoneRegion::kRightLamina}, {}, "laminae only"};
    case 2:
      return {{spinous[0], spinous[1], spinous[2], second ? facet : lamina},
              {},
              "spinous process and " + side + (second ? " facet" : " lamina")};
    default:
      return {every_region(), third_off(bone, marks, right ? -1 : 1, second, random),
              side + " side without its " + (second ? "upper" : "lower") + " third"};
  }
}

}  // namespace

StrokeCoverage cover_all(const TouchableBone& bone, const PosteriorLandmarks& marks,
                         double wanted_m, Random& random) {
  return {walks_of_length(bone, marks, every_region(), wanted_m, random), "all"};
}

StrokeCoverage cover_part(const TouchableBone& bone, const PosteriorLandmarks& marks,
                          double wanted_m, Random& random) {
  const Part part = drawn_part(bone, marks, random);
  return {walks_of_length(bone, marks, part.regions, wanted_m, random, part.cut), part.words};
}

StrokeCoverage cover_sparsely(const TouchableBone& bone, const PosteriorLandmarks& marks,
                              double wanted_m, int count, Random& random) {
  const double piece_m = wanted_m / count;
  constexpr double kPitch_m = 0.0025;
  std::vector<std::vector<Walk>> by_region;
  for (const BoneRegion region : every_region()) {
    auto walks = walks_over(bone, marks, {region}, kPitch_m, random, {});
    // A small process has no long strokes but still gets its share of the few.
    double longest_m = 0.0;
    for (const Walk& walk : walks) {
      longest_m = std::max(longest_m, walk.length_m());
    }
    std::erase_if(walks, [&](const Walk& walk) {
      return walk.length_m() < 0.7 * std::min(piece_m, longest_m);
    });
    if (!walks.empty()) {
      by_region.push_back(std::move(walks));
    }
  }
  StrokeCoverage coverage{{}, "few short strokes"};
  // Takes each region in turn, so that no part of the bone is left out.
  for (int k = 0; k < count && !by_region.empty(); ++k) {
    const auto& walks = by_region[static_cast<std::size_t>(k) % by_region.size()];
    const Walk& walk =
        walks[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(walks.size())))];
    const double from_m = random.uniform(0.0, std::max(0.0, walk.length_m() - piece_m));
    coverage.walks.push_back(walk.part(from_m, from_m + piece_m));
  }
  return coverage;
}

}  // namespace orthonav::test
