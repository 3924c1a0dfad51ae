#include "nav/tracking/full_image_search.h"

namespace orthonav::nav {

FullImageSearch::FullImageSearch(std::unique_ptr<PairDetector> detector, bool parallel)
    : detector_(std::move(detector)) {
  detector_->left_plan().everywhere = detector_->right_plan().everywhere = true;
  if (parallel) {
    worker_.emplace();
  }
}

Result<std::unique_ptr<FullImageSearch>> FullImageSearch::create(const DetectorOptions& options,
                                                                 bool parallel) {
  // One thread, since it runs in the background and has time until the next pair.
  Result<std::unique_ptr<PairDetector>> detector = PairDetector::create(options, false);
  if (!detector) {
    return detector.error();
  }
  return std::make_unique<FullImageSearch>(std::move(detector).value(), parallel);
}

void FullImageSearch::run(void* self) {
  auto& search = *static_cast<FullImageSearch*>(self);
  search.detector_->detect(search.frame_);
}

void FullImageSearch::start(const StereoFrame& frame) {
  frame_.left = frame.left;
  frame_.right = frame.right;
  begun_ = true;
  if (worker_) {
    worker_->start(&run, this);
  } else {
    run(this);
  }
}

void FullImageSearch::finish() {
  if (begun_ && worker_) {
    worker_->wait();
  }
  found_ = begun_;
  begun_ = false;
}

std::span<const MarkerCorners> FullImageSearch::left() const {
  return found_ ? detector_->left() : std::span<const MarkerCorners>{};
}

std::span<const MarkerCorners> FullImageSearch::right() const {
  return found_ ? detector_->right() : std::span<const MarkerCorners>{};
}

}  // namespace orthonav::nav
