#pragma once

#include <cstdint>
#include <vector>

#include "hal/sim/cameras/room_renderer_ground.h"
#include "hal/sim/cameras/room_renderer_lens.h"

namespace orthonav::sim {

/// The part of the bones that may be visible: the triangles above the tissue, of every level, in
/// Spine. With `cell_m` > 0 the surface is thinned by clustering vertices in cells of that size.
struct ShownBones {
  std::vector<float> x, y, z;
  std::vector<float> lit;     ///< light received, lamp and sky, 0 to about 1
  std::vector<float> height;  ///< above the tissue, m
  std::vector<std::array<std::uint32_t, 3>> triangles;

  ShownBones(const RoomDescription& room, const Ground& ground, double cell_m);
};

/// A depth-buffered image of the bones. A bone is visible where it rises above the tissue and is
/// seen through the wound.
class BoneImage {
 public:
  void reset(int width_px, int height_px);
  /// `scale` reduces the lens's pixels to those of this image.
  template <class AnyLens>
  void draw(const ShownBones& bones, const Ground& ground,
            const Transform<LeftCamera, Spine>& camera_from_spine, const AnyLens& lens,
            double scale);

  /// Inverse depth, 0 where there is no bone.
  [[nodiscard]] const std::vector<float>& nearness() const { return nearness_; }
  [[nodiscard]] const std::vector<float>& lit() const { return lit_; }
  [[nodiscard]] const std::vector<float>& height() const { return height_; }
  /// Rows in which anything was drawn: [low, high).
  [[nodiscard]] int low_row() const { return low_row_; }
  [[nodiscard]] int high_row() const { return high_row_; }

 private:
  struct Vertex {
    float x = 0.0F;
    float y = 0.0F;
    float nearness = 0.0F;  ///< 0: not drawable
    float lit = 0.0F;
    float height = 0.0F;
    float seen = 0.0F;  ///< above 0: through the wound
  };
  void draw(const Vertex& a, const Vertex& b, const Vertex& c);

  int width_ = 0;
  int height_px_ = 0;
  int low_row_ = 0;
  int high_row_ = 0;
  std::vector<float> nearness_;
  std::vector<float> lit_;
  std::vector<float> height_;
  std::vector<Vertex> vertices_;
};

}  // namespace orthonav::sim
