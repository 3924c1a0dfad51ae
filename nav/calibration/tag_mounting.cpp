#include "nav/calibration/tag_mounting.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numbers>

#include "base/angle.h"

namespace orthonav::nav {
namespace {

/// The tool may be hand-made and differ from its description; a quarter turn is still far beyond
/// this.
constexpr double kMaxTilt_rad = 30.0 * kRadiansPerDegree;
constexpr double kMaxTranslation_m = 0.030;
/// Makes an angle a length, to weigh both: tags of a tool lie some 50 mm apart.
constexpr double kMountingLever_m = 0.05;
/// A turn of the marker must explain the places by this factor better than no turn: if all tags lie
/// on the marker's axis, it explains them equally well, and turns of the tags themselves are the
/// simpler explanation.
constexpr double kClearlyBetter = 0.5;

Mat3 quarter_turns_about_z(int turns) {
  return rotation_from_vector({0, 0, turns * std::numbers::pi / 2});
}

struct Pair {
  const BodyTag* measured;
  const AttachedMarker* described;
};

std::vector<Pair> in_both(std::span<const BodyTag> measured,
                          std::span<const AttachedMarker> described) {
  std::vector<Pair> pairs;
  for (std::size_t i = 1; i < measured.size(); ++i) {
    const MarkerDefinition& tag = measured[i].definition;
    const auto same =
        std::find_if(described.begin(), described.end(), [&](const AttachedMarker& d) {
          return d.definition.family == tag.family && d.definition.id == tag.id;
        });
    if (same != described.end()) {
      pairs.push_back({&measured[i], &*same});
    }
  }
  return pairs;
}

/// How a tag is mounted if the marker is turned by that many quarter turns.
struct Reading {
  int turns = 0;
  double tilt_rad = 0.0;
  double translation_m = 0.0;

  [[nodiscard]] double misfit_m() const { return translation_m + kMountingLever_m * tilt_rad; }
};

Reading reading_of(const Pair& pair, int marker_turns) {
  const Mat3 rotated_from_marker = quarter_turns_about_z(-marker_turns);
  const Transform<Marker, Tag>& described = pair.described->marker_from_tag;
  const Transform<Marker, Tag>& measured = pair.measured->marker_from_tag;
  Reading best;
  best.tilt_rad = std::numeric_limits<double>::max();
  for (int turns = 0; turns < 4; ++turns) {
    const Mat3 expected = rotated_from_marker * described.rotation() * quarter_turns_about_z(turns);
    const double tilt_rad = rotation_angle_rad(expected, measured.rotation());
    if (tilt_rad < best.tilt_rad) {
      best.turns = turns;
      best.tilt_rad = tilt_rad;
    }
  }
  best.translation_m =
      (rotated_from_marker * described.translation() - measured.translation()).norm();
  return best;
}

double misfit_m(std::span<const Pair> pairs, int marker_turns) {
  double sum_m = 0.0;
  for (const Pair& pair : pairs) {
    sum_m += reading_of(pair, marker_turns).misfit_m();
  }
  return sum_m;
}

int turns_of_marker(std::span<const Pair> pairs) {
  int best = 0;
  double limit_m = kClearlyBetter * misfit_m(pairs, 0);
  for (int turns = 1; turns < 4; ++turns) {
    const double now_m = misfit_m(pairs, turns);
    if (now_m < limit_m) {
      best = turns;
      limit_m = now_m;
    }
  }
  return best;
}

}  // namespace

std::vector<RotatedTag> rotated_tags(std::span<const BodyTag> measured,
                                     std::span<const AttachedMarker> described) {
  const std::vector<Pair> pairs = in_both(measured, described);
  const int of_marker = turns_of_marker(pairs);
  std::vector<RotatedTag> rotated;
  if (of_marker != 0) {
    rotated.push_back({measured.front().definition, of_marker});
  }
  for (const Pair& pair : pairs) {
    const Reading reading = reading_of(pair, of_marker);
    if (reading.tilt_rad > kMaxTilt_rad || reading.translation_m > kMaxTranslation_m) {
      return {};
    }
    if (reading.turns != 0) {
      rotated.push_back({pair.measured->definition, reading.turns});
    }
  }
  return rotated;
}

}  // namespace orthonav::nav
