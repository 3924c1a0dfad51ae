#include <algorithm>
#include <cmath>

#include "hal/sim/room_renderer_ground.h"

// The colours of cloth, skin and tissue, in linear light.
namespace orthonav::sim {
namespace {

using Colour = std::array<float, 3>;

constexpr Colour kDrapeColour{0.035F, 0.200F, 0.235F};
constexpr Colour kSkinColour{0.560F, 0.270F, 0.130F};  // under iodine film
constexpr Colour kFatColour{0.700F, 0.470F, 0.200F};
constexpr Colour kMuscleColour{0.330F, 0.055F, 0.040F};
constexpr Colour kDeepColour{0.120F, 0.016F, 0.014F};
constexpr Colour kFloorColour{0.060F, 0.075F, 0.085F};
constexpr Colour kRoomColour{0.090F, 0.110F, 0.120F};

Colour mix(const Colour& a, const Colour& b, float s) {
  return {a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]), a[2] + s * (b[2] - a[2])};
}

Colour scaled(const Colour& a, float s) { return {a[0] * s, a[1] * s, a[2] * s}; }

float smooth_step(float from, float to, float v) {
  const float s = std::clamp((v - from) / (to - from), 0.0F, 1.0F);
  return s * s * (3.0F - 2.0F * s);
}

}  // namespace

std::array<float, 3> Ground::drape_colour(const Hit& hit) const {
  const float x = hit.x - wound_x_;
  const float z = hit.z - wound_z_;
  const float side = std::abs(x) / 0.45F;
  // Folds run from the window outwards; weave and shade make it cloth.
  const float fold = blotches_.at(1.1F * x + 0.25F * z, 0.35F * z + 0.2F);
  const float crease = blotches_.at(2.3F * x + 0.4F * z, 1.0F * z + 0.6F);
  float light = 0.62F + 0.75F * fold + 0.25F * crease - 0.35F * side * side;
  if (wound_) {
    const float edge =
        std::max(std::abs(x) - half_width_ - 0.030F, std::abs(z) - half_length_ - 0.030F);
    light *= edge < 0.006F ? 1.35F : 1.0F;  // the hem
  }
  return scaled(kDrapeColour, light);
}

std::array<float, 3> Ground::colour(const Hit& hit) const {
  switch (hit.kind) {
    case Kind::kNothing:
      return scaled(kRoomColour, 1.0F + 0.5F * std::clamp(hit.lamp, -1.0F, 1.0F));
    case Kind::kFloor:
      return scaled(kFloorColour, 0.8F + 0.4F * blotches_.at(0.25F * hit.x, 0.25F * hit.z));
    case Kind::kDrape:
      return drape_colour(hit);
    case Kind::kSkin: {
      const float pores = blotches_.at(9.0F * hit.x, 9.0F * hit.z);
      const float rim = smooth_step(1.22F, 1.0F, hit.skin_rim);
      const float hem = std::max(std::abs(hit.x - wound_x_) - half_width_ - 0.022F,
                                 std::abs(hit.z - wound_z_) - half_length_ - 0.022F);
      const float shade = hem > 0.0F ? 1.0F - 45.0F * hem : 1.0F;  // of the drape's edge
      return scaled(mix(kSkinColour, kFatColour, 0.7F * rim),
                    shade * (0.85F + 0.3F * pores) * (1.0F - 0.25F * rim));
    }
    case Kind::kWall: {
      // From the fat under the skin down to muscle.
      const float deep = smooth_step(1.0F, 1.9F, hit.rim);
      const float strands = blotches_.at(14.0F * hit.x, 5.0F * hit.z + 8.0F * hit.y);
      const Colour c =
          mix(kMuscleColour, kFatColour, 0.55F * smooth_step(0.9F, 1.0F, hit.skin_rim));
      return scaled(c, (0.65F + 0.6F * strands) * (0.8F - 0.25F * deep));
    }
    case Kind::kTissue: {
      const float strands = blotches_.at(13.0F * hit.x, 5.0F * hit.z);
      const float blood = blotches_.at(4.0F * hit.x + 0.3F, 4.0F * hit.z);
      const float rim = smooth_step(0.35F, 1.0F, hit.rim);
      const Colour c = mix(kMuscleColour, kDeepColour,
                           std::clamp(0.9F * rim + 1.4F * (blood - 0.55F), 0.0F, 1.0F));
      return scaled(c, 0.6F + 0.85F * strands);
    }
  }
  return {0, 0, 0};
}

}  // namespace orthonav::sim
