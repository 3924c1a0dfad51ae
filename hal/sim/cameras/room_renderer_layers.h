#pragma once

#include <vector>

#include "hal/sim/cameras/room_renderer_coverage.h"
#include "hal/sim/cameras/room_renderer_lens.h"
#include "hal/sim/cameras/room_renderer_solids.h"

namespace orthonav::sim {

/// The foreground of a frame: the light that bodies send and how much of the background they hide,
/// averaged over the exposure. Only the part of each row named in `spans` is not zero.
struct Foreground {
  int width_px = 0;
  int height_px = 0;
  int channels = 0;
  std::vector<float> light;  ///< channels planes, times opacity already
  std::vector<float> opacity;
  std::vector<CoverageWindow::Span> spans;

  void reset(int width, int height, int channel_count);
  [[nodiscard]] std::size_t row(int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px);
  }
  [[nodiscard]] std::size_t plane() const { return opacity.size(); }
};

/// Draws bodies with exact area coverage, each into a layer of its own, and merges the layers by
/// depth in each pixel. Memory is kept from frame to frame.
class Layers {
 public:
  Layers();
  /// Draws one moment and adds it with its weight. `hidden_by`, if given, is the inverse depth of
  /// the background in each pixel, which hides bodies behind it.
  void add_moment(const Solids& solids, const Lens& lens, float weight, Foreground& sum,
                  const float* hidden_by = nullptr);

 private:
  struct Layer {
    int x0 = 0;
    int y0 = 0;
    int width = 0;
    int height = 0;
    std::size_t alpha = 0;  ///< offset of the window in the arena
    std::size_t light = 0;
    std::size_t spans = 0;
    // Inverse depth as a linear function of the pixel: exact for planes, apart from distortion.
    float nearness0 = 0.0F;
    float nearness_x = 0.0F;
    float nearness_y = 0.0F;
    Tint tint{1, 1, 1};
    int tool = -1;
    int rank = 0;  ///< decides within one tool, where depths are too close to call

    [[nodiscard]] float nearness(int x, int y) const {
      return nearness0 + nearness_x * static_cast<float>(x) + nearness_y * static_cast<float>(y);
    }
  };
  /// One layer's part of one row, addressed by the image's columns.
  struct RowLayer {
    const Layer* layer = nullptr;
    int low = 0;
    int high = 0;
    const float* alpha = nullptr;
    const float* light = nullptr;
  };
  /// Pixels merged at a time.
  static constexpr int kBlockPx = 16;

  Layer* open_layer(Vec2 low, Vec2 high, const Lens& lens);
  void draw(const Plate& plate, const Lens& lens);
  /// Fills the contour in corners_px_; returns the sign that makes the inside positive.
  double fill_outline(const Layer& layer, double grey);
  void project_face(const Plate& plate, const Lens& lens, const Layer& layer);
  void draw_face(const Plate& plate, const Lens& lens, Layer& layer, double sign);
  void draw(const Capsule& capsule, Vec3 lamp_in_camera, const Lens& lens);
  static void set_depth(const Capsule& capsule, Vec2 a, Vec2 b, Layer& layer);
  void shade(const Capsule& capsule, Vec3 lamp_in_camera, Vec2 a, Vec2 b, double radius_a,
             double radius_b, Layer& layer);
  void integrate(const Layer& layer, std::size_t window);
  void merge(float weight, Foreground& sum, const float* hidden_by);
  void order_block(int y, int from, int to);
  [[nodiscard]] bool order_holds(int last, int y, bool grey) const;
  void merge_block(int y, int from, int to, float weight, Foreground& sum, const float* hidden_by);
  void merge_pixel(int x, int y, float weight, Foreground& sum, const float* hidden_by);
  /// Adds columns [from, to) of a layer behind the existing content; `left`, from column `block`
  /// on, is the fraction of light that still gets through.
  static void lay_under(const RowLayer& row, int y, int block, int from, int to, float* left,
                        Foreground& sum, const float* hidden_by);
  static void lay_block_under(const RowLayer& row, int y, int block, int from, int to, float* left,
                              Foreground& sum);
  [[nodiscard]] static bool in_front(const Layer& a, const Layer& b, int x, int y);
  void wipe();

  std::vector<Layer> layers_;
  std::vector<float> arena_;  ///< zero between moments
  std::vector<CoverageWindow::Span> spans_;
  std::size_t arena_used_ = 0;
  std::size_t spans_used_ = 0;
  std::vector<Vec2> corners_px_;
  std::vector<RowLayer> in_row_;
  std::vector<const RowLayer*> active_;
};

}  // namespace orthonav::sim
