#pragma once

#include <optional>
#include <vector>

#include "base/image.h"
#include "hal/api/camera_model.h"
#include "nav/tracking/photometric_view.h"

namespace orthonav::nav {

/// How well an image agrees with a tag at a position, judged at the middles of its cells.
struct CellMatch {
  Vec2 offset_px{};          ///< from where the pose puts the tag
  double correlation = 0.0;  ///< of grey and template, over the cells in the image
  double code = 0.0;         ///< the same over the cells that distinguish ids
  double fraction = 0.0;     ///< of the cells that lie in the image
};

/// Searches for a tag around where a pose puts it, by its bits: a correlation over the middles of
/// its cells, which no change of light affects. Reuses its memory.
class TagSearch {
 public:
  /// The agreement at the pose itself.
  [[nodiscard]] CellMatch match(const GreyImage& image, const CameraModel& camera,
                                const BlurredTag& tag, const CameraFromTag& pose);
  /// The best whole-pixel shift within `radius_px` (at most 40) of the pose last matched.
  [[nodiscard]] CellMatch best_offset(const GreyImage& image, int radius_px) const;

 private:
  [[nodiscard]] CellMatch at(const GreyImage& image, int dx, int dy) const;
  [[nodiscard]] double code_at(const GreyImage& image, Vec2 offset_px) const;

  struct Cell {
    int x_px = 0;
    int y_px = 0;
    float white = 0.0F;
    bool code = false;
  };
  std::vector<Cell> cells_;
  std::size_t all_cells_ = 0;
};

}  // namespace orthonav::nav
