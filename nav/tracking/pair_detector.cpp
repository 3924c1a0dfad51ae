#include "nav/tracking/pair_detector.h"

#include <algorithm>
#include <cmath>

namespace orthonav::nav {
namespace {

constexpr double kFarPx = 1e5;

}  // namespace

void SearchPlan::add(const TagCorners& corners_px, const BoxRoom& room, std::string_view family,
                     int id) {
  Vec2 low = corners_px[0];
  Vec2 high = low;
  for (const Vec2 corner : corners_px) {
    low = {std::min(low.x, corner.x), std::min(low.y, corner.y)};
    high = {std::max(high.x, corner.x), std::max(high.y, corner.y)};
  }
  const double extent_px = std::max(high.x - low.x, high.y - low.y);
  const double room_px = room.px + room.of_extent * extent_px;
  // Negated, so that non-finite corners stay out as well.
  if (!(std::abs(low.x) + std::abs(low.y) + extent_px + room_px < kFarPx)) {
    return;
  }
  const auto whole = [](double v) { return static_cast<int>(std::floor(v)); };
  boxes.push_back(
      {{whole(low.x - room_px), whole(low.y - room_px), whole(high.x - low.x + 2.0 * room_px) + 1,
        whole(high.y - low.y + 2.0 * room_px) + 1},
       family,
       id});
}

PairDetector::PairDetector(MarkerDetector left, MarkerDetector right, bool parallel)
    : left_{std::move(left), {}, nullptr, {}, {}}, right_{std::move(right), {}, nullptr, {}, {}} {
  if (parallel) {
    worker_.emplace();
  }
}

Result<std::unique_ptr<PairDetector>> PairDetector::create(const DetectorOptions& options,
                                                           bool parallel) {
  Result<MarkerDetector> left = MarkerDetector::create(options);
  if (!left) {
    return left.error();
  }
  Result<MarkerDetector> right = MarkerDetector::create(options);
  if (!right) {
    return right.error();
  }
  return std::make_unique<PairDetector>(std::move(left).value(), std::move(right).value(),
                                        parallel);
}

void PairDetector::detect_side(void* argument) {
  Side& side = *static_cast<Side*>(argument);
  side.found.clear();
  if (side.plan.everywhere) {
    if (!side.detector.detect(*side.image, side.found)) {
      side.found.clear();
    }
    return;
  }
  for (const SearchPlan::Box& box : side.plan.boxes) {
    if (!side.detector.detect(*side.image, box.box, side.in_box)) {
      continue;
    }
    // Boxes may overlap: only the tag that a box was made for counts, or a tag would be found
    // twice.
    for (const MarkerCorners& marker : side.in_box) {
      if (marker.family == box.family && marker.id == box.id) {
        side.found.push_back(marker);
      }
    }
  }
}

void PairDetector::detect(const StereoFrame& frame) {
  left_.image = &frame.left;
  right_.image = &frame.right;
  if (worker_) {
    worker_->start(&detect_side, &right_);
  }
  detect_side(&left_);
  if (worker_) {
    worker_->wait();
  } else {
    detect_side(&right_);
  }
}

}  // namespace orthonav::nav
