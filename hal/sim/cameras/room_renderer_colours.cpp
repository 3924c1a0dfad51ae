#include <algorithm>
#include <cmath>

#include "hal/sim/cameras/room_renderer_ground.h"

// The colours of cloth, skin, tissue and retractor, in linear light: for people alone.
namespace orthonav::sim {
namespace {

using Colour = std::array<float, 3>;

constexpr Colour kDrapeColour{0.035F, 0.200F, 0.235F};
constexpr Colour kSkinColour{0.560F, 0.270F, 0.130F};  // under iodine film
constexpr Colour kFatColour{0.720F, 0.490F, 0.190F};
constexpr Colour kFasciaColour{0.620F, 0.480F, 0.420F};
constexpr Colour kMuscleColour{0.360F, 0.060F, 0.042F};
constexpr Colour kDeepColour{0.120F, 0.014F, 0.012F};
constexpr Colour kSteelColour{0.430F, 0.460F, 0.480F};
constexpr Colour kFloorColour{0.060F, 0.075F, 0.085F};
constexpr Colour kRoomColour{0.090F, 0.110F, 0.120F};

constexpr float kBladeHalfWidth = 0.012F;
constexpr float kArmHalfWidth = 0.005F;
/// Two pairs of blades, this fraction of the wound's half length from its middle.
constexpr float kBladesApart = 0.45F;
/// Unit, towards the lamp (the same as the bones').
constexpr Colour kLamp{0.3015F, 0.9045F, 0.3015F};

Colour mix(const Colour& a, const Colour& b, float s) {
  return {a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]), a[2] + s * (b[2] - a[2])};
}

Colour scaled(const Colour& a, float s) { return {a[0] * s, a[1] * s, a[2] * s}; }

Colour brighter(const Colour& a, float by) { return {a[0] + by, a[1] + by, a[2] + by}; }

float smooth_step(float from, float to, float v) {
  const float s = std::clamp((v - from) / (to - from), 0.0F, 1.0F);
  return s * s * (3.0F - 2.0F * s);
}

Colour unit(const Colour& a) {
  return scaled(a, 1.0F / std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]));
}

/// The lamp mirrored in something wet, 0 to 1 (Blinn 1977): a cosine squared so many times.
/// Neither vector has to be of unit length.
float wet_shine(const Colour& normal, const Colour& direction, int squared) {
  const Colour n = unit(normal);
  const Colour to_eye = scaled(unit(direction), -1.0F);
  const Colour half = unit({to_eye[0] + kLamp[0], to_eye[1] + kLamp[1], to_eye[2] + kLamp[2]});
  float shine = std::max(n[0] * half[0] + n[1] * half[1] + n[2] * half[2], 0.0F);
  for (int i = 0; i < squared; ++i) {
    shine *= shine;
  }
  return shine;
}

/// Brushed steel that is a little hollow from edge to edge.
Colour steel_colour(float across, float shade) {
  const float hollow = 0.45F + 0.9F * smooth_step(0.1F, 0.8F, 0.5F + 0.45F * across);
  const float edge = std::abs(across) > 0.88F ? 1.5F : 1.0F;
  return scaled(kSteelColour, shade * hollow * edge);
}

}  // namespace

float Ground::across_blade(float z) const {
  const float from_middle = std::abs(z - wound_z_) - kBladesApart * half_length_;
  return from_middle / kBladeHalfWidth;
}

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

std::array<float, 3> Ground::skin_colour(const Hit& hit) const {
  const float aside = std::abs(hit.x - wound_x_);
  const float hem =
      std::max(aside - half_width_ - 0.022F, std::abs(hit.z - wound_z_) - half_length_ - 0.022F);
  const float shade = hem > 0.0F ? 1.0F - 45.0F * hem : 1.0F;  // of the drape's edge
  // The retractor: the blades' lips over the skin, and an arm from each out under the drape.
  const float across = across_blade(hit.z);
  const bool lip = std::abs(across) < 1.0F && hit.skin_rim < 1.22F;
  const bool arm = std::abs(across) * kBladeHalfWidth < kArmHalfWidth;
  if (aside > 0.6F * half_width_ && (lip || arm)) {
    return steel_colour(lip ? across : across * kBladeHalfWidth / kArmHalfWidth, 1.05F * shade);
  }
  const float pores = blotches_.at(9.0F * hit.x, 9.0F * hit.z);
  const float smear = smooth_step(0.45F, 0.75F, blotches_.at(5.0F * hit.x + 0.6F, 5.0F * hit.z)) *
                      smooth_step(1.5F, 1.0F, hit.skin_rim);
  const float cut = smooth_step(1.10F, 1.0F, hit.skin_rim);
  Colour c = scaled(kSkinColour, shade * (0.85F + 0.3F * pores));
  c = mix(c, kMuscleColour, 0.7F * smear);
  return mix(c, kFatColour, 0.8F * cut);
}

std::array<float, 3> Ground::wall_colour(const Hit& hit,
                                         const std::array<float, 3>& direction) const {
  // The place on the upright wall: how deep, and where.
  const float deep = (1.0F - hit.skin_rim) / std::max(hit.rim - hit.skin_rim, 1e-3F);
  const float back = (1.0F - deep) * kDepth / std::min(direction[1], -1e-3F);
  const float x = hit.x + back * direction[0];
  const float z = hit.z + back * direction[2];
  const float across = across_blade(z);
  if (std::abs(across) < 1.0F && std::abs(x - wound_x_) > 0.6F * half_width_) {
    return steel_colour(across, 1.0F - 0.55F * deep);
  }
  const float strands = blotches_.at(14.0F * (x + z), 4.0F * z + 9.0F * deep * kDepth);
  const float bump =
      blotches_.at(14.0F * (x + z) + 0.02F, 4.0F * z + 9.0F * deep * kDepth) - strands;
  Colour c = mix(kFatColour, kFasciaColour, smooth_step(0.16F, 0.20F, deep));
  c = mix(c, kMuscleColour, smooth_step(0.20F, 0.26F, deep));
  c = mix(c, kDeepColour, 0.8F * smooth_step(0.35F, 1.0F, deep));
  const Colour inwards{(wound_x_ - x) / half_width_ + 4.0F * bump, 0.7F, 4.0F * bump};
  return brighter(scaled(c, 0.5F + 0.75F * strands), 0.25F * wet_shine(inwards, direction, 5));
}

std::array<float, 3> Ground::tissue_colour(const Hit& hit,
                                           const std::array<float, 3>& direction) const {
  // Muscle runs along the back; its strands are rounded and wet.
  const auto height = [&](float x, float z) { return blotches_.at(13.0F * x, 5.0F * z); };
  constexpr float kStep = 0.0008F;
  const float strands = height(hit.x, hit.z);
  const float across = (height(hit.x + kStep, hit.z) - strands) / kStep;
  const float along = (height(hit.x, hit.z + kStep) - strands) / kStep;
  const float blood = blotches_.at(4.0F * hit.x + 0.3F, 4.0F * hit.z);
  const float rim = smooth_step(0.35F, 1.0F, hit.rim);
  const float pool = smooth_step(0.55F, 0.75F, blood);
  const Colour c =
      mix(kMuscleColour, kDeepColour, std::clamp(0.85F * rim + 0.9F * pool, 0.0F, 1.0F));
  const float bumps = 0.0035F * (1.0F - 0.8F * pool);  // blood lies level
  const float shine = wet_shine({-bumps * across, 1.0F, -bumps * along}, direction, 6);
  return brighter(scaled(c, 0.5F + 0.75F * strands), 0.45F * (1.0F - 0.7F * rim) * shine);
}

std::array<float, 3> Ground::colour(const Hit& hit, const std::array<float, 3>& direction) const {
  switch (hit.kind) {
    case Kind::kNothing:
      return scaled(kRoomColour, 1.0F + 0.5F * std::clamp(hit.lamp, -1.0F, 1.0F));
    case Kind::kFloor:
      return scaled(kFloorColour, 0.8F + 0.4F * blotches_.at(0.25F * hit.x, 0.25F * hit.z));
    case Kind::kDrape:
      return drape_colour(hit);
    case Kind::kSkin:
      return skin_colour(hit);
    case Kind::kWall:
      return wall_colour(hit, direction);
    case Kind::kTissue:
      return tissue_colour(hit, direction);
  }
  return {0, 0, 0};
}

}  // namespace orthonav::sim
