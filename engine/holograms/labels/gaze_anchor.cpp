#include "engine/holograms/labels/gaze_anchor.h"

#include <algorithm>
#include <cmath>

#include "engine/holograms/shapes/hologram_cross.h"

namespace orthonav::engine {
namespace {

double apart(const std::array<double, 2>& a, const std::array<double, 2>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1]);
}

}  // namespace

std::optional<GazeAnchor::Axes> GazeAnchor::axes_of(const Hanging& hanging) {
  const Vec3 from_site = hanging.world_from_head.translation() - hanging.site.v;
  const Vec3 across = hanging.world_from_head.rotation().column(1).cross(from_site);
  if (!(across.norm() > 1e-3 * from_site.norm())) {
    return std::nullopt;
  }
  const Vec3 towards = from_site.normalized();
  const Vec3 right = across.normalized();
  return Axes{right, towards.cross(right), towards};
}

std::optional<GazeAnchor::Across> GazeAnchor::looked_at(const Hanging& hanging, const Axes& axes,
                                                        const Gaze& gaze) {
  const double along = axes.towards.dot(gaze.direction.v);
  const double distance_m = axes.towards.dot(hanging.site - gaze.origin) / along;
  if (!(std::abs(along) > 1e-6 && distance_m > 0.0)) {
    return std::nullopt;
  }
  return axes.of(gaze.origin + distance_m * gaze.direction.v - hanging.site);
}

bool GazeAnchor::covered(const Across& place, const Across& anchor, LabelSide side) {
  // Of the rings and the texts beside them, with the numbers below.
  constexpr double kHalfWidth_m = 0.035;
  constexpr double kAbove_m = 0.030;
  constexpr double kBelow_m = 0.065;
  const double aside_m =
      static_cast<double>(side == LabelSide::kLeft ? -kCrossAside_m : kCrossAside_m);
  const double right_m = place[0] - anchor[0] - aside_m;
  const double up_m = place[1] - anchor[1] - static_cast<double>(kCrossAbove_m);
  return std::abs(right_m) <= kHalfWidth_m && up_m <= kAbove_m && up_m >= -kBelow_m;
}

bool GazeAnchor::covers_entry(const Hanging& hanging, const Axes& axes, const Across& anchor) {
  return std::any_of(
      hanging.entries_of.begin(), hanging.entries_of.end(), [&](const PlacedLevel& at) {
        const auto& screws = at.level->plan.screws;
        return std::any_of(screws.begin(), screws.end(), [&](const nav::ScrewPlan& screw) {
          const Vec3 from_site = at.world_from_vertebra * screw.entry - hanging.site;
          return covered(axes.of(from_site), anchor, hanging.side);
        });
      });
}

void GazeAnchor::rest_on(const Across& place, const Gaze& gaze) {
  const bool goes_on =
      resting_on_ && apart(*resting_on_, place) <= kResting_m && gaze.time - seen_ <= kOldest;
  if (!goes_on) {
    resting_on_ = place;
    resting_since_ = gaze.time;
  }
  seen_ = gaze.time;
}

std::optional<Direction<Vertebra>> GazeAnchor::follow(const Hanging& hanging,
                                                      const std::optional<Gaze>& gaze,
                                                      Timestamp now) {
  if (!gaze || now - gaze->time > kOldest) {
    return offset_;
  }
  const auto axes = axes_of(hanging);
  if (!axes) {
    return offset_;
  }
  const Across anchor =
      offset_ ? axes->of((hanging.world_from_vertebra * *offset_).v) : Across{0.0, 0.0};
  const auto place = looked_at(hanging, *axes, *gaze);
  if (!place || !(std::hypot((*place)[0], (*place)[1]) <= kNear_m) ||
      covered(*place, anchor, hanging.side)) {
    resting_on_.reset();
    return offset_;
  }
  rest_on(*place, *gaze);
  const Across& rested = *resting_on_;
  if (gaze->time - resting_since_ >= kRests && apart(rested, anchor) >= kMoves_m &&
      !covers_entry(hanging, *axes, rested)) {
    const Direction<World> aside{rested[0] * axes->right + rested[1] * axes->up};
    offset_ = hanging.world_from_vertebra.inverse() * aside;
  }
  return offset_;
}

}  // namespace orthonav::engine
