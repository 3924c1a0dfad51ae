#include "study/rod_in_hand.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/angle.h"
#include "nav/geometry/absolute_orientation.h"

namespace orthonav::engine {
namespace {

// Estimates; with the spacing of a lumbar spine's levels.
constexpr double kHeadSpacing_m = 0.035;
constexpr double kHeadSpacingSd_m = 0.003;
constexpr double kLordosisOfLevel_rad = 10.0 * kRadiansPerDegree;
constexpr double kLordosisOfLevelSd_rad = 3.0 * kRadiansPerDegree;
constexpr double kHeadSidewaysSd_m = 0.0025;
constexpr double kHeadDepthSd_m = 0.0015;
/// No head is set farther off than this many SDs.
constexpr double kFarthestHead_sd = 2.5;

/// Closest points settle within a few rounds; after these the rest is nanometres.
constexpr int kLayingRounds = 15;

struct RodFoot {
  Vec3 foot_m;
  double distance_m = std::numeric_limits<double>::infinity();
  double along_m = 0.0;  ///< from the first place
};

RodFoot foot_on(std::span<const Vec3> places_m, Vec3 seat_m) {
  RodFoot nearest;
  double before_m = 0.0;
  for (std::size_t i = 0; i + 1 < places_m.size(); ++i) {
    const Vec3 chord_m = places_m[i + 1] - places_m[i];
    const double length_m = chord_m.norm();
    const double low_m = i == 0 ? -std::numeric_limits<double>::infinity() : 0.0;
    const double high_m =
        i + 2 == places_m.size() ? std::numeric_limits<double>::infinity() : length_m;
    const double along_m =
        std::clamp((seat_m - places_m[i]).dot(chord_m) / length_m, low_m, high_m);
    const Vec3 foot_m = places_m[i] + (along_m / length_m) * chord_m;
    const double distance_m = (seat_m - foot_m).norm();
    if (distance_m < nearest.distance_m) {
      nearest = {foot_m, distance_m, before_m + along_m};
    }
    before_m += length_m;
  }
  return nearest;
}

double drawn_within(Random& random, double sd) {
  return sd * std::clamp(random.normal(), -kFarthestHead_sd, kFarthestHead_sd);
}

}  // namespace

Vec3 rod_rotation_rad(Vec3 from, Vec3 to) {
  const Vec3 axis = from.cross(to);
  const double sine = axis.norm();
  return sine > 0.0 ? (angle_between_rad(from, to) / sine) * axis : Vec3{};
}

RodInHand RodInHand::straight(std::span<const Vec3> seats_m) {
  RodInHand rod;
  const Vec3 direction = (seats_m[1] - seats_m[0]).normalized();
  rod.places_m_.push_back(seats_m[0]);
  for (std::size_t i = 1; i < seats_m.size(); ++i) {
    rod.places_m_.push_back(rod.places_m_.back() +
                            (seats_m[i] - seats_m[i - 1]).norm() * direction);
  }
  return rod;
}

void RodInHand::lengthen(std::size_t i, double by_m) {
  const Vec3 offset_m = by_m * chord_m(i).normalized();
  for (std::size_t j = i + 1; j < places_m_.size(); ++j) {
    places_m_[j] += offset_m;
  }
}

void RodInHand::bend(std::size_t joint, Vec3 rotation_rad) {
  const Vec3 axis = (places_m_[joint] - places_m_[joint - 1]).normalized();
  const Mat3 rotation = rotation_from_vector(rotation_rad - rotation_rad.dot(axis) * axis);
  for (std::size_t j = joint + 1; j < places_m_.size(); ++j) {
    places_m_[j] = places_m_[joint] + rotation * (places_m_[j] - places_m_[joint]);
  }
}

RodLie RodInHand::lay_on(std::span<const Vec3> seats_m) {
  std::vector<Vec3> feet_m(seats_m.size());
  for (int round = 0; round < kLayingRounds; ++round) {
    std::transform(seats_m.begin(), seats_m.end(), feet_m.begin(),
                   [&](Vec3 seat_m) { return foot_on(places_m_, seat_m).foot_m; });
    const auto fit = nav::absolute_orientation(feet_m, seats_m);
    if (!fit) {
      break;  // two heads, or all on a line: it lies as it was made
    }
    for (Vec3& place_m : places_m_) {
      place_m = fit->rotation * place_m + fit->translation_m;
    }
  }
  RodLie lie;
  for (const Vec3& seat_m : seats_m) {
    const double distance_m = foot_on(places_m_, seat_m).distance_m;
    lie.mean_m += distance_m / static_cast<double>(seats_m.size());
    lie.largest_m = std::max(lie.largest_m, distance_m);
  }
  lie.span_m =
      foot_on(places_m_, seats_m.back()).along_m - foot_on(places_m_, seats_m.front()).along_m;
  return lie;
}

RodCorrection RodInHand::worst_bend(std::span<const Vec3> seats_m) const {
  RodCorrection worst{1, {}};
  for (std::size_t i = 1; i + 1 < seats_m.size(); ++i) {
    const Vec3 rotation_rad = rod_rotation_rad(chord_m(i), seats_m[i + 1] - seats_m[i]) -
                              rod_rotation_rad(chord_m(i - 1), seats_m[i] - seats_m[i - 1]);
    if (rotation_rad.norm() > worst.rotation_rad.norm()) {
      worst = {i, rotation_rad};
    }
  }
  return worst;
}

RodInHand RodInHand::along(std::vector<Vec3> places_m) {
  RodInHand rod;
  rod.places_m_ = std::move(places_m);
  return rod;
}

RodCorrection RodInHand::worst_bend_near(std::span<const Vec3> seats_m) const {
  RodInHand through_feet;
  for (const Vec3& seat_m : seats_m) {
    through_feet.places_m_.push_back(foot_on(places_m_, seat_m).foot_m);
  }
  RodCorrection worst = through_feet.worst_bend(seats_m);
  const Vec3 at_m = through_feet.places_m_[worst.joint];
  const auto nearest = std::min_element(
      places_m_.begin() + 1, places_m_.end() - 1,
      [&](Vec3 a, Vec3 b) { return (a - at_m).squared_norm() < (b - at_m).squared_norm(); });
  worst.joint = static_cast<std::size_t>(nearest - places_m_.begin());
  return worst;
}

std::vector<Vec3> drawn_lumbar_heads_m(Random& random) {
  const auto count = static_cast<std::size_t>(3.0 + std::floor(4.0 * random.uniform()));
  double tilt_rad = -0.5 * kLordosisOfLevel_rad * static_cast<double>(count - 2);
  Vec3 middle_m;
  std::vector<Vec3> heads_m;
  for (std::size_t i = 0; i < count; ++i) {
    heads_m.push_back(middle_m + Vec3{drawn_within(random, kHeadSidewaysSd_m),
                                      drawn_within(random, kHeadDepthSd_m), 0.0});
    const double gap_m = kHeadSpacing_m + drawn_within(random, kHeadSpacingSd_m);
    middle_m += gap_m * Vec3{0.0, std::sin(tilt_rad), std::cos(tilt_rad)};
    tilt_rad += kLordosisOfLevel_rad + drawn_within(random, kLordosisOfLevelSd_rad);
  }
  return heads_m;
}

std::vector<Vec3> rod_screw_directions(std::span<const Vec3> heads_m, Vec3 to_bone) {
  std::vector<Vec3> directions;
  for (std::size_t i = 0; i < heads_m.size(); ++i) {
    const Vec3 along =
        (heads_m[std::min(i + 1, heads_m.size() - 1)] - heads_m[i == 0 ? 0 : i - 1]).normalized();
    const Vec3 across = to_bone.normalized() - to_bone.normalized().dot(along) * along;
    directions.push_back(across.norm() > 0.1 ? across.normalized() : Vec3{});
  }
  return directions;
}

}  // namespace orthonav::engine
