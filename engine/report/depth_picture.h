#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/image.h"
#include "base/vec.h"
#include "nav/geometry/mesh.h"

namespace orthonav::engine {

/// A view of a model in parallel projection: unit vectors in the model's frame, right x up =
/// towards the viewer.
struct Viewpoint {
  Vec3 right;
  Vec3 up;
  Vec3 toward;

  /// Millimetres to the right of and below the model's origin, as in drawings.
  [[nodiscard]] Vec2 on_page_mm(Vec3 place_m) const {
    return {place_m.dot(right) * 1e3, -place_m.dot(up) * 1e3};
  }
};

/// A rectangle of the page, millimetres.
struct PageArea {
  Vec2 low_mm;
  Vec2 high_mm;
  [[nodiscard]] Vec2 size_mm() const { return high_mm - low_mm; }
};

struct Rgb {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
};

/// The colour of a surface: `near` where a value given at its vertices is below the limit.
struct SurfacePaint {
  std::span<const double> values;  ///< one per vertex; empty: `far` everywhere
  double limit = 0.0;
  Rgb near;
  Rgb far;
  /// If given: the colours of values from 0 to the limit, in equal steps, with the last one beyond;
  /// `far` where the value is NaN.
  std::span<const Rgb> steps{};
};

/// A shaded picture of surfaces with a depth buffer, four samples per pixel. Plain arithmetic on
/// one thread: the same surfaces give the same bytes, with or without a graphics device.
class DepthPicture {
 public:
  /// At the requested resolution, unless a side would exceed 1,200 pixels.
  DepthPicture(const Viewpoint& view, const PageArea& area, double pixels_per_mm);
  /// At equal depths, it covers earlier surfaces.
  void draw(const nav::TriangleMesh& mesh, const SurfacePaint& paint);
  /// Whether a surface lies in front of the place by more than `by_m`.
  [[nodiscard]] bool hides(Vec3 place_m, double by_m) const;
  /// Transparent where there is no surface.
  [[nodiscard]] RgbaImage image() const;

 private:
  struct Corner {
    double x = 0.0;  ///< samples
    double y = 0.0;
    double nearness_m = 0.0;  ///< towards the viewer
    double light = 0.0;
    double value = 0.0;
  };
  void fill(const std::array<Corner, 3>& corners, const SurfacePaint& paint);
  void put(std::size_t sample, const Corner& at, const SurfacePaint& paint);

  Viewpoint view_;
  PageArea area_;
  double samples_per_mm_ = 1.0;
  int width_ = 0;  ///< samples
  int height_ = 0;
  std::vector<float> nearness_m_;
  std::vector<std::uint8_t> rgba_;
};

}  // namespace orthonav::engine
