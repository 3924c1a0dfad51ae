#include "engine/session/landmarking.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace orthonav::engine {
namespace {

double distance_m(Point<World> place, const ReferencePost& post) {
  const Vec3 along = post.foot - post.tag;
  const double length2_m2 = std::max(along.dot(along), 1e-12);
  const double way = std::clamp((place - post.tag).dot(along) / length2_m2, 0.0, 1.0);
  return (place - (post.tag + way * along)).norm();
}

double nearest_m(Point<World> place, std::span<const ReferencePost> posts) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const ReferencePost& post : posts) {
    least_m = std::min(least_m, distance_m(place, post));
  }
  return least_m;
}

/// How far from all of them the bone that a pointer reaches extends.
double farthest_m(const LevelState& level, std::span<const ReferencePost> posts) {
  double most_m = 0.0;
  for (const Vec3 vertex : level.plan.model->reachable().vertices_m) {
    const Point<World> place = level.registration->world_from_vertebra * Point<Vertebra>{vertex};
    most_m = std::max(most_m, nearest_m(place, posts));
  }
  return most_m;
}

}  // namespace

void Landmarking::begin() {
  forget_touches();
  recorded_here_ = false;
  touch_.drop();
}

std::optional<TouchRefusal> Landmarking::too_near(const LevelState& level, Point<World> place,
                                                  std::span<const ReferencePost> posts) const {
  const double here_m = nearest_m(place, posts);
  if (here_m >= rules_.from_reference_m) {
    return std::nullopt;
  }
  const double limit_m = std::min(rules_.from_reference_m, rules_.reach * farthest_m(level, posts));
  if (here_m >= limit_m) {
    return std::nullopt;
  }
  return TouchRefusal{TouchRefusal::Kind::kTooNear, here_m, limit_m};
}

std::optional<TouchRefusal> Landmarking::refusal_of(const LevelState& level,
                                                    const nav::PressedPlace& place,
                                                    Point<Vertebra> here,
                                                    std::span<const ReferencePost> posts,
                                                    bool anchored) {
  if (touches_ > 0) {
    const double apart_m = (here - mean_place()).norm();
    const double sd_m = std::max(place.sd_m, std::sqrt(variances_m2_ / touches_));
    const double limit_m = rules_.apart_m(sd_m, anchored);
    if (!(apart_m <= limit_m)) {
      return TouchRefusal{TouchRefusal::Kind::kTouchesApart, apart_m, limit_m};
    }
  }
  return level.landmark ? std::nullopt : too_near(level, place.place, posts);
}

std::variant<LandmarkTouch, TouchRefusal> Landmarking::take(LevelState& level,
                                                            const TouchedPlace& place,
                                                            std::span<const ReferencePost> posts,
                                                            bool anchored, Timestamp time) {
  const auto* pressed = std::get_if<nav::PressedPlace>(&place);
  if (!pressed) {
    return std::get<TouchRefusal>(place);
  }
  const Point<Vertebra> here = level.registration->world_from_vertebra.inverse() * pressed->place;
  if (last_ && last_->missing == 0) {
    forget_touches();
  }
  if (const auto refusal = refusal_of(level, *pressed, here, posts, anchored)) {
    forget_touches();
    return *refusal;
  }
  sum_m_ += here.v;
  variances_m2_ += pressed->sd_m * pressed->sd_m;
  ++touches_;
  const double recorded_sd_m = level.landmark ? level.landmark->sd_m : sd_m();
  const double distance_sd_m = rules_.distance_sd_m(recorded_sd_m, sd_m(), anchored);
  last_ = LandmarkTouch{!level.landmark, std::max(0, rules_.touches_of(anchored) - touches_), 0.0,
                        rules_.limit_m(distance_sd_m), distance_sd_m};
  if (last_->missing > 0) {
    return *last_;
  }
  if (level.landmark) {
    last_->off_m = (mean_place() - level.landmark->in_vertebra).norm();
  } else {
    level.landmark = Landmark{mean_place(), sd_m(), time};
    recorded_here_ = true;
  }
  return *last_;
}

void Landmarking::forget_touches() {
  last_.reset();
  sum_m_ = {};
  variances_m2_ = 0.0;
  touches_ = 0;
}

Landmarking::Dropped Landmarking::drop(LevelState& level) {
  if (!last_) {
    return Dropped::kNothing;
  }
  const Dropped dropped = last_->missing > 0 ? Dropped::kTouch : Dropped::kPlace;
  if (recorded_here_) {
    level.landmark.reset();
  }
  recorded_here_ = false;
  forget_touches();
  return dropped;
}

}  // namespace orthonav::engine
