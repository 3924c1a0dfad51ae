#pragma once

#include "hal/api/camera_model.h"
#include "hal/sim/cameras/room_renderer.h"

namespace orthonav::sim {

/// Where a point of the camera frame (x right, y down, z forward) falls on the image. The map
/// continues smoothly past the image's edge, so that bodies that extend beyond it can be clipped.
class Lens {
 public:
  virtual ~Lens() = default;
  /// `in_camera_m.z` must be positive.
  [[nodiscard]] virtual Vec2 pixel(Vec3 in_camera_m) const = 0;
  /// Within about 0.1 px and many times faster: for shapes that are not measured.
  [[nodiscard]] virtual Vec2 rough_pixel(Vec3 in_camera_m) const = 0;
  /// Pixels per radian at the centre, for sizes that need not be exact.
  [[nodiscard]] virtual double focal_px() const = 0;
  [[nodiscard]] virtual int width_px() const = 0;
  [[nodiscard]] virtual int height_px() const = 0;
};

/// The device's camera with its distortion.
class CameraLens final : public Lens {
 public:
  explicit CameraLens(const CameraModel& camera);
  [[nodiscard]] Vec2 pixel(Vec3 in_camera_m) const override;
  [[nodiscard]] double focal_px() const override { return focal_px_; }
  [[nodiscard]] int width_px() const override { return camera_.width_px(); }
  [[nodiscard]] int height_px() const override { return camera_.height_px(); }
  [[nodiscard]] Vec2 rough_pixel(Vec3 in_camera_m) const override;
  /// The ray (x, y, 1) of the pixel, NaN where the camera sees nothing.
  [[nodiscard]] Vec3 ray(int column, int row) const {
    const Vec2 v = camera_.lookup()[index(column, row)];
    return {v.x, v.y, 1.0};
  }

 private:
  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(camera_.width_px()) +
           static_cast<std::size_t>(column);
  }
  [[nodiscard]] Vec2 linear(Vec2 unit_plane) const;

  const CameraModel& camera_;
  Vec2 centre_ray_{};
  Vec2 scale_px_{1.0, 1.0};
  double focal_px_ = 1.0;
};

/// A view without distortion; square pixels are not required.
class PinholeLens final : public Lens {
 public:
  PinholeLens(const PinholeView& view, int width_px, int height_px);
  [[nodiscard]] Vec2 pixel(Vec3 in_camera_m) const override {
    return {scale_.x * in_camera_m.x / in_camera_m.z + centre_.x,
            scale_.y * in_camera_m.y / in_camera_m.z + centre_.y};
  }
  [[nodiscard]] double focal_px() const override { return 0.5 * (scale_.x + scale_.y); }
  [[nodiscard]] int width_px() const override { return width_px_; }
  [[nodiscard]] int height_px() const override { return height_px_; }
  [[nodiscard]] Vec2 rough_pixel(Vec3 in_camera_m) const override { return pixel(in_camera_m); }
  [[nodiscard]] Vec3 ray(Vec2 pixel_px) const {
    return {(pixel_px.x - centre_.x) / scale_.x, (pixel_px.y - centre_.y) / scale_.y, 1.0};
  }

 private:
  int width_px_;
  int height_px_;
  Vec2 scale_;
  Vec2 centre_;
};

/// A depth camera's lens, with the functions that the bones' renderer calls.
struct DepthLens {
  const BrownConrady& lens;
  [[nodiscard]] Vec2 rough_pixel(Vec3 in_camera_m) const {
    const Vec2 at{in_camera_m.x / in_camera_m.z, in_camera_m.y / in_camera_m.z};
    // Far outside the image the polynomial folds back into it.
    constexpr double kTrusted = 1.8;
    return at.norm() < kTrusted
               ? lens.distort(at)
               : Vec2{lens.cx_px + lens.fx_px * at.x, lens.cy_px + lens.fy_px * at.y};
  }
};

}  // namespace orthonav::sim
