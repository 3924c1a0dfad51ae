#include "nav/tracking/full_image_search.h"

namespace orthonav::nav {

WholeSearch::WholeSearch(std::unique_ptr<PairDetector> detector, bool parallel)
    : detector_(std::move(detector)) {
  detector_->left_plan().everywhere = detector_->right_plan().everywhere = true;
  if (parallel) worker_.emplace();
}

Result<std::unique_ptr<WholeSearch>> WholeSearch::create(const DetectorOptions& options,
                                                         bool parallel) {
  // One thread in the background: it has the time until the next pair.
  Result<std::unique_ptr<PairDetector>> detector = PairDetector::create(options, false);
  if (!detector) return detector.error();
  return std::make_unique<WholeSearch>(std::move(detector).value(), parallel);
}

void WholeSearch::run(void* self) {
  auto& search = *static_cast<WholeSearch*>(self);
  search.detector_->detect(search.frame_);
}

void WholeSearch::start(const StereoFrame& frame) {
  frame_.left = frame.left;
  frame_.right = frame.right;
  begun_ = true;
  if (worker_)
    worker_->start(&run, this);
  else
    run(this);
}

void WholeSearch::finish() {
  if (begun_ && worker_) worker_->wait();
  found_ = begun_;
  begun_ = false;
}

std::span<const MarkerCorners> WholeSearch::left() const {
  return found_ ? detector_->left() : std::span<const MarkerCorners>{};
}

std::span<const MarkerCorners> WholeSearch::right() const {
  return found_ ? detector_->right() : std::span<const MarkerCorners>{};
}

}  // namespace orthonav::nav
