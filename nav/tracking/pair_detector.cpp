#include "nav/tracking/pair_detector.h"

namespace orthonav::nav {

PairDetector::PairDetector(MarkerDetector left, MarkerDetector right, bool parallel)
    : left_{std::move(left), {}, nullptr, {}, {}}, right_{std::move(right), {}, nullptr, {}, {}} {
  if (parallel) worker_.emplace();
}

Result<std::unique_ptr<PairDetector>> PairDetector::create(const DetectorOptions& options,
                                                           bool parallel) {
  Result<MarkerDetector> left = MarkerDetector::create(options);
  if (!left) return left.error();
  Result<MarkerDetector> right = MarkerDetector::create(options);
  if (!right) return right.error();
  return std::make_unique<PairDetector>(std::move(left).value(), std::move(right).value(),
                                        parallel);
}

void PairDetector::detect_side(void* argument) {
  Side& side = *static_cast<Side*>(argument);
  side.found.clear();
  if (side.plan.everywhere) {
    if (!side.detector.detect(*side.image, side.found)) side.found.clear();
    return;
  }
  for (const SearchPlan::Box& box : side.plan.boxes) {
    if (!side.detector.detect(*side.image, box.box, side.in_box)) continue;
    // Boxes overlap: only the tag that a box was made for counts, or it would be found twice.
    for (const MarkerCorners& marker : side.in_box)
      if (marker.family == box.family && marker.id == box.id) side.found.push_back(marker);
  }
}

void PairDetector::detect(const StereoFrame& frame) {
  left_.image = &frame.left;
  right_.image = &frame.right;
  if (worker_) worker_->start(&detect_side, &right_);
  detect_side(&left_);
  if (worker_)
    worker_->wait();
  else
    detect_side(&right_);
}

}  // namespace orthonav::nav
