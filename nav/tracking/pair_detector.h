#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "hal/api/devices.h"
#include "nav/tracking/marker_detector.h"
#include "nav/tracking/tag_pose.h"
#include "nav/tracking/worker.h"

namespace orthonav::nav {

/// Margin around a tag's expected corners on every side: a fraction of their extent, and pixels.
struct BoxRoom {
  double of_extent = 0.0;
  double px = 0.0;
};

/// Where to look in one image: everywhere, or in boxes that each concern one tag.
struct SearchPlan {
  struct Box {
    PixelBox box;
    std::string_view family;
    int id = 0;
  };
  bool everywhere = true;
  std::vector<Box> boxes;

  /// Plans a box around a tag; none if the corners are not finite or far outside any image.
  void add(const TagCorners& corners_px, const BoxRoom& room, std::string_view family, int id);
};

/// Finds tags in pairs of images. One thread at a time.
class TagFinder {
 public:
  virtual ~TagFinder() = default;
  [[nodiscard]] virtual SearchPlan& left_plan() = 0;
  [[nodiscard]] virtual SearchPlan& right_plan() = 0;
  /// Fills `left()` and `right()` as planned.
  virtual void detect(const StereoFrame& frame) = 0;
  [[nodiscard]] virtual std::span<const MarkerCorners> left() const = 0;
  [[nodiscard]] virtual std::span<const MarkerCorners> right() const = 0;
};

/// Detects tags in both images of a pair, concurrently when a second thread is given; the result is
/// the same.
class PairDetector final : public TagFinder {
 public:
  static Result<std::unique_ptr<PairDetector>> create(const DetectorOptions& options,
                                                      bool parallel);
  PairDetector(MarkerDetector left, MarkerDetector right, bool parallel);

  [[nodiscard]] SearchPlan& left_plan() override { return left_.plan; }
  [[nodiscard]] SearchPlan& right_plan() override { return right_.plan; }
  /// An image that the detector refuses shows no tags.
  void detect(const StereoFrame& frame) override;
  [[nodiscard]] std::span<const MarkerCorners> left() const override { return left_.found; }
  [[nodiscard]] std::span<const MarkerCorners> right() const override { return right_.found; }

 private:
  struct Side {
    MarkerDetector detector;
    SearchPlan plan;
    const GreyImage* image = nullptr;
    std::vector<MarkerCorners> found;
    std::vector<MarkerCorners> in_box;
  };
  static void detect_side(void* side);

  Side left_;
  Side right_;
  std::optional<Worker> worker_;
};

}  // namespace orthonav::nav
