#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "hal/sim/room/room.h"

namespace orthonav::sim {

/// A patch of smooth random values in [0, 1] that repeats; for blotches, folds and tissue.
class Blotches {
 public:
  Blotches();
  /// Bilinear; one repetition per unit of x and y.
  [[nodiscard]] float at(float x, float y) const {
    const float u = (x - std::floor(x)) * kPatch;
    const float v = (y - std::floor(y)) * kPatch;
    const int i = static_cast<int>(u) & (kPatch - 1);
    const int j = static_cast<int>(v) & (kPatch - 1);
    const float s = u - static_cast<float>(static_cast<int>(u));
    const float t = v - static_cast<float>(static_cast<int>(v));
    const float* top = values_.data() + j * kPatch;
    const float* bottom = values_.data() + ((j + 1) & (kPatch - 1)) * kPatch;
    const int k = (i + 1) & (kPatch - 1);
    return (1 - t) * ((1 - s) * top[i] + s * top[k]) + t * ((1 - s) * bottom[i] + s * bottom[k]);
  }

 private:
  static constexpr int kPatch = 128;
  std::vector<float> values_;
};

/// The patient's back under the drape with the open wound, in the frame of the spine: x left,
/// y posterior (up, the patient lies prone), z superior. Without a spine, a draped table.
class Ground {
 public:
  enum class Kind { kNothing, kFloor, kDrape, kSkin, kWall, kTissue };
  struct Hit {
    Kind kind = Kind::kNothing;
    float x = 0.0F;
    float y = 0.0F;
    float z = 0.0F;
    float distance = 0.0F;  ///< along the ray, in lengths of `direction`
    float rim = 0.0F;       ///< 0 at the wound's middle, 1 at its rim, at the surface hit
    float skin_rim = 0.0F;  ///< the same where the ray passed the level of the skin
    float lamp = 0.0F;      ///< elevation of the ray, for what is beyond the floor
  };
  explicit Ground(const RoomDescription& room);

  [[nodiscard]] Hit hit(const std::array<float, 3>& origin,
                        const std::array<float, 3>& direction) const;
  /// Grey as the cameras see it.
  [[nodiscard]] float grey(const Hit& hit) const;
  /// Colour (linear light) for people; `direction` is the ray's, of any length.
  [[nodiscard]] std::array<float, 3> colour(const Hit& hit,
                                            const std::array<float, 3>& direction) const;

  /// Height of the skin, and of the tissue between the bones.
  [[nodiscard]] float skin_height(float z) const {
    const float t = std::min(std::max(z, low_), high_) - z0_;
    return a_ + t * (b_ + t * c_);
  }
  [[nodiscard]] float tissue_height(float z) const { return skin_height(z) - kDepth; }
  /// 0 in the wound's middle, 1 on its rim.
  [[nodiscard]] float rim_at(float x, float z) const {
    const float u = (x - wound_x_) / half_width_;
    const float v = (z - wound_z_) / half_length_;
    return u * u + v * v * v * v;
  }

 private:
  static constexpr float kDepth = 0.036F;
  void reach(const std::array<float, 3>& origin, const std::array<float, 3>& direction,
             float below_skin, Hit& hit) const;
  [[nodiscard]] std::array<float, 3> drape_colour(const Hit& hit) const;
  [[nodiscard]] std::array<float, 3> skin_colour(const Hit& hit) const;
  [[nodiscard]] std::array<float, 3> wall_colour(const Hit& hit,
                                                 const std::array<float, 3>& direction) const;
  [[nodiscard]] std::array<float, 3> tissue_colour(const Hit& hit,
                                                   const std::array<float, 3>& direction) const;
  /// How far across the nearest blade of the retractor a place is: 0 in its middle, 1 on its edges.
  [[nodiscard]] float across_blade(float z) const;

  Blotches blotches_;
  bool wound_ = false;
  // Skin height: a + b (z - z0) + c (z - z0)², constant outside [low, high].
  float z0_ = 0.0F;
  float a_ = 0.0F;
  float b_ = 0.0F;
  float c_ = 0.0F;
  float low_ = 0.0F;
  float high_ = 0.0F;
  float wound_x_ = 0.0F;
  float wound_z_ = 0.0F;
  float half_width_ = 0.04F;
  float half_length_ = 0.08F;
};

}  // namespace orthonav::sim
