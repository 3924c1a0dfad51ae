#include "engine/session/touched_heads.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "engine/session/touch.h"

namespace orthonav::engine {

std::variant<HeadTouch, TouchRefusal> TouchedHeads::add(const nav::PressedPlace& touched,
                                                        Vec3 shaft) {
  const std::optional<std::size_t> head = head_near(touched.place);
  if (!head) {
    touches_.push_back({heads_++, touched, shaft});
    return last();
  }
  const double others = static_cast<double>(touches_of(*head));
  const double sd_m = std::max(stated_sd_m(*head), std::hypot(kSeatingSd_m, touched.sd_m));
  const double limit_m =
      kHeadSds * std::hypot(sd_m, tracking_sd_m()) * std::sqrt(1.0 + 1.0 / others);
  const double apart_m = (touched.place - place_of(*head)).norm();
  if (!(apart_m <= limit_m)) {
    return TouchRefusal{TouchRefusal::Kind::kTouchesApart, apart_m, limit_m};
  }
  touches_.push_back({*head, touched, shaft});
  return last();
}

std::optional<HeadTouch> TouchedHeads::drop_last() {
  if (touches_.empty()) {
    return std::nullopt;
  }
  const HeadTouch dropped = last();
  touches_.pop_back();
  // Heads are numbered in order of first touch, so the one without a touch left is the last.
  heads_ -= dropped.touches == 1 ? 1 : 0;
  return dropped;
}

std::vector<Point<World>> TouchedHeads::places() const {
  std::vector<Point<World>> places;
  for (std::size_t head = 0; head < heads_; ++head) {
    places.push_back(place_of(head));
  }
  return places;
}

std::size_t TouchedHeads::touches_of(std::size_t head) const {
  std::size_t count = 0;
  for (const OneTouch& touch : touches_) {
    count += touch.head == head ? 1 : 0;
  }
  return count;
}

Point<World> TouchedHeads::place_of(std::size_t head) const {
  Vec3 sum;
  for (const OneTouch& touch : touches_) {
    sum += touch.head == head ? touch.at.place.v : Vec3{};
  }
  return {sum / static_cast<double>(touches_of(head))};
}

double TouchedHeads::stated_sd_m(std::size_t head) const {
  double squares_m2 = 0.0;
  for (const OneTouch& touch : touches_) {
    squares_m2 += touch.head == head ? touch.at.sd_m * touch.at.sd_m : 0.0;
  }
  return std::hypot(kSeatingSd_m, std::sqrt(squares_m2 / static_cast<double>(touches_of(head))));
}

double TouchedHeads::sd_m(std::size_t head) const {
  const Point<World> place = place_of(head);
  double squares_m2 = 0.0;
  for (const OneTouch& touch : touches_) {
    squares_m2 += touch.head == head ? (touch.at.place - place).squared_norm() : 0.0;
  }
  return std::hypot(
      sd_of_mean(stated_sd_m(head), squares_m2, 3.0, static_cast<double>(touches_of(head))),
      tracking_sd_m());
}

Vec3 TouchedHeads::pointed() const {
  Vec3 sum;
  for (const OneTouch& touch : touches_) {
    sum += -touch.shaft;
  }
  return sum;
}

HeadTouch TouchedHeads::last() const {
  ORTHONAV_CHECK(!touches_.empty());
  const OneTouch& touch = touches_.back();
  return {touch.head, touch.at.place, touch.at.sd_m, touches_of(touch.head), sd_m(touch.head)};
}

std::optional<std::size_t> TouchedHeads::head_near(Point<World> place) const {
  std::optional<std::size_t> nearest;
  double nearest_m = kSameHead_m;
  for (std::size_t head = 0; head < heads_; ++head) {
    const double away_m = (place - place_of(head)).norm();
    if (away_m < nearest_m) {
      nearest = head;
      nearest_m = away_m;
    }
  }
  return nearest;
}

}  // namespace orthonav::engine
