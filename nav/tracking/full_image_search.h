#pragma once

#include <memory>
#include <optional>
#include <span>

#include "nav/tracking/pair_detector.h"
#include "nav/tracking/worker.h"

namespace orthonav::nav {

/// Searches a whole pair of images for tags while the next pair is awaited. It starts at the end of
/// one pair's tracking and delivers its results at the beginning of the next, so the results do not
/// depend on the number of threads.
class FullImageSearch {
 public:
  static Result<std::unique_ptr<FullImageSearch>> create(const DetectorOptions& options,
                                                         bool parallel);
  FullImageSearch(std::unique_ptr<PairDetector> detector, bool parallel);

  /// Copies the images and starts; with one thread, searches at once.
  void start(const StereoFrame& frame);
  /// Waits for the search, if one was started; its results stay until the next call. Without a
  /// search they are empty.
  void finish();
  [[nodiscard]] std::span<const MarkerCorners> left() const;
  [[nodiscard]] std::span<const MarkerCorners> right() const;

 private:
  static void run(void* self);

  std::unique_ptr<PairDetector> detector_;
  StereoFrame frame_;
  bool begun_ = false;
  bool found_ = false;
  std::optional<Worker> worker_;
};

}  // namespace orthonav::nav
