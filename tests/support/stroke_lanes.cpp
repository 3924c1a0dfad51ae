#include "tests/support/stroke_lanes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace orthonav::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// A strip of the bone: the first lane runs from a to b, the last one from c to d.
struct Strip {
  Vec3 a, b, c, d;
};

class LaneMaker {
 public:
  LaneMaker(BoneRegion region, const PosteriorLandmarks& marks, double pitch_m, Random& random)
      : region_(region),
        side_(side_of(region)),
        marks_(marks),
        pitch_m_(pitch_m),
        random_(random),
        across_(random.uniform() < 0.5) {}

  /// Seen from behind, `first_m` to `last_m` from the midline; the handle `in_deg` to `out_deg`
  /// outwards.
  void from_behind(double first_m, double last_m, double in_deg, double out_deg) {
    const double x0 = marks_.midline_x_m + side_ * first_m;
    const double x1 = marks_.midline_x_m + side_ * last_m;
    const double y = marks_.arch_front_y_m;
    cover({{x0, y, marks_.low_z_m},
           {x0, y, marks_.high_z_m},
           {x1, y, marks_.low_z_m},
           {x1, y, marks_.high_z_m}},
          side_ * in_deg, side_ * out_deg);
  }
  /// The side of the spinous process, aimed at its middle plane past the retracted muscles.
  void from_aside() {
    constexpr double kRoot_m = 0.006;
    const double x = marks_.midline_x_m;
    const double root_y = marks_.arch_front_y_m + kRoot_m;
    cover({{x, root_y, marks_.low_z_m},
           {x, root_y, marks_.high_z_m},
           {x, marks_.crest_y_m, marks_.low_z_m},
           {x, marks_.crest_y_m, marks_.high_z_m}},
          side_ * 45.0, side_ * 70.0);
  }
  void along_the_crest() {
    constexpr double kHalf_m = 0.004;
    across_ = false;
    const double x = marks_.midline_x_m;
    const double y = marks_.crest_y_m;
    cover({{x - kHalf_m, y, marks_.low_z_m},
           {x - kHalf_m, y, marks_.high_z_m},
           {x + kHalf_m, y, marks_.low_z_m},
           {x + kHalf_m, y, marks_.high_z_m}},
          -15.0, 15.0);
  }
  std::vector<Lane> lanes;

 private:
  void cover(Strip strip, double first_deg, double last_deg) {
    if (across_) {
      std::swap(strip.b, strip.c);
    }
    const double breadth_m = (strip.c - strip.a).norm();
    const int count = std::max(1, static_cast<int>(std::lround(breadth_m / pitch_m_)));
    for (int k = 0; k < count; ++k) {
      const double f = (k + random_.uniform(0.2, 0.8)) / count;
      const double g = (k + random_.uniform(0.2, 0.8)) / count;
      Lane lane{.region = region_,
                .from_m = strip.a + f * (strip.c - strip.a),
                .to_m = strip.b + g * (strip.d - strip.b),
                .left_rad = random_.uniform(first_deg, last_deg) * kDegree,
                .up_rad = random_.uniform(-15.0, 15.0) * kDegree,
                .sway_m = random_.uniform(0.0002, 0.0010),
                .wave_m = random_.uniform(0.010, 0.025),
                .phase_rad = random_.uniform(0.0, 2.0 * std::numbers::pi)};
      if (k % 2 == 1) {
        std::swap(lane.from_m, lane.to_m);
      }
      lanes.push_back(lane);
    }
  }

  BoneRegion region_;
  double side_;
  const PosteriorLandmarks& marks_;
  double pitch_m_;
  Random& random_;
  bool across_;  ///< lanes from side to side (or from root to crest), else up and down
};

}  // namespace

const char* name_of(BoneRegion region) {
  constexpr std::array<const char*, kBoneRegions> kNames{"left lamina",
                                                         "right lamina",
                                                         "left facet",
                                                         "right facet",
                                                         "root of the left transverse process",
                                                         "root of the right transverse process",
                                                         "left side of the spinous process",
                                                         "right side of the spinous process",
                                                         "crest of the spinous process"};
  return kNames[static_cast<std::size_t>(region)];
}

int side_of(BoneRegion region) {
  if (region == BoneRegion::kCrest) {
    return 0;
  }
  return static_cast<int>(region) % 2 == 0 ? 1 : -1;
}

Vec3 Lane::approach(double more_left_rad, double more_up_rad) const {
  const double left = left_rad + more_left_rad;
  const double up = up_rad + more_up_rad;
  return {std::sin(left) * std::cos(up), std::cos(left) * std::cos(up), std::sin(up)};
}

std::vector<Lane> lanes_over(BoneRegion region, const PosteriorLandmarks& landmarks, double pitch_m,
                             Random& random) {
  constexpr double kBesideCrest_m = 0.004;
  const double width_m = landmarks.canal_half_width_m;
  LaneMaker make(region, landmarks, pitch_m, random);
  switch (region) {
    case BoneRegion::kLeftLamina:
    case BoneRegion::kRightLamina:
      make.from_behind(kBesideCrest_m, 1.4 * width_m, 0, 20);
      break;
    case BoneRegion::kLeftFacet:
    case BoneRegion::kRightFacet:
      make.from_behind(1.3 * width_m, 2.0 * width_m, 0, 25);
      make.from_behind(1.4 * width_m, 2.1 * width_m, 35, 55);
      break;
    case BoneRegion::kLeftTransverseRoot:
    case BoneRegion::kRightTransverseRoot:
      make.from_behind(1.9 * width_m, 2.5 * width_m, -5, 25);
      break;
    case BoneRegion::kLeftSpinousSide:
    case BoneRegion::kRightSpinousSide:
      make.from_aside();
      break;
    case BoneRegion::kCrest:
      make.along_the_crest();
      break;
  }
  return std::move(make.lanes);
}

}  // namespace orthonav::test
