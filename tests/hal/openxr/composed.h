#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/srgb.h"
#include "tests/support/openxr_runtime/runtime_double.h"

namespace orthonav::test {

/// The picture that a compositor makes of a frame's layers for each eye: linear light in [0, 1],
/// three values a pixel, row by row. A quad is sampled once a pixel, bilinearly, and laid over the
/// eyes' images with premultiplied alpha. Works only for images in sRGB, eyes whose axes are
/// parallel to the head's, and a quad that hangs on the head.
class Composed {
 public:
  using Light = std::array<double, 4>;

  explicit Composed(const SubmittedFrame& frame, int width_px, int height_px)
      : frame_(frame), width_px_(width_px), height_px_(height_px) {}

  [[nodiscard]] std::vector<double> eye(std::size_t eye) const {
    std::vector<double> light;
    light.reserve(3ul * width_px_ * height_px_);
    for (int y = 0; y < height_px_; ++y) {
      for (int x = 0; x < width_px_; ++x) {
        const std::uint8_t* below = &frame_.pixels[eye][4ul * (y * width_px_ + x)];
        const Light over = quad_at(eye, x + 0.5, y + 0.5);
        for (std::size_t c = 0; c < 3; ++c) {
          light.push_back(std::min(1.0, over[c] + (1 - over[3]) * linear(below[c])));
        }
      }
    }
    return light;
  }

 private:
  static double linear(std::uint8_t value) { return linear_from_srgb(value / 255.0); }

  [[nodiscard]] Light texel(int x, int y) const {
    const SubmittedQuad& quad = *frame_.quad;
    x = std::clamp(x, 0, quad.width_px - 1);
    y = std::clamp(y, 0, quad.height_px - 1);
    const std::uint8_t* at = &(*quad.pixels)[4ul * (y * quad.width_px + x)];
    return {linear(at[0]), linear(at[1]), linear(at[2]), at[3] / 255.0};
  }

  [[nodiscard]] Light sampled(double u_px, double v_px) const {
    const double x = std::floor(u_px - 0.5);
    const double y = std::floor(v_px - 0.5);
    const double right = u_px - 0.5 - x;
    const double down = v_px - 0.5 - y;
    Light light{};
    for (const int i : {0, 1}) {
      for (const int j : {0, 1}) {
        const Light one = texel(static_cast<int>(x) + i, static_cast<int>(y) + j);
        const double weight = (i == 1 ? right : 1 - right) * (j == 1 ? down : 1 - down);
        for (std::size_t c = 0; c < 4; ++c) {
          light[c] += weight * one[c];
        }
      }
    }
    return light;
  }

  /// What the quad shows at a place of an eye's image; nothing outside the quad.
  [[nodiscard]] Light quad_at(std::size_t eye, double x_px, double y_px) const {
    if (!frame_.quad) {
      return {};
    }
    const SubmittedQuad& quad = *frame_.quad;
    const XrFovf& fov = frame_.fovs[eye];
    const double left = std::tan(static_cast<double>(fov.angleLeft));
    const double right = std::tan(static_cast<double>(fov.angleRight));
    const double up = std::tan(static_cast<double>(fov.angleUp));
    const double down = std::tan(static_cast<double>(fov.angleDown));
    const std::array<double, 3> ray = {left + x_px / width_px_ * (right - left),
                                       up + y_px / height_px_ * (down - up), -1};
    const auto& a = frame_.poses[0].position;
    const auto& b = frame_.poses[1].position;
    const double half = 0.5 * std::hypot(b.x - a.x, b.y - a.y, b.z - a.z);
    // From the quad's middle to the eye, in the head's axes; turned into the quad's axes below.
    const std::array<double, 3> eye_at = {
        (eye == 0 ? -half : half) - static_cast<double>(quad.pose.position.x),
        -static_cast<double>(quad.pose.position.y), -static_cast<double>(quad.pose.position.z)};
    const auto from = turned_back(quad.pose.orientation, eye_at);
    const auto along = turned_back(quad.pose.orientation, ray);
    const double t = -from[2] / along[2];
    const double across = (from[0] + t * along[0]) / static_cast<double>(quad.size.width);
    const double upwards = (from[1] + t * along[1]) / static_cast<double>(quad.size.height);
    if (!(t > 0 && std::abs(across) < 0.5 && std::abs(upwards) < 0.5)) {
      return {};
    }
    Light light = sampled((0.5 + across) * quad.width_px, (0.5 - upwards) * quad.height_px);
    const bool by_alpha = (quad.flags & XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT) != 0;
    light[3] = by_alpha ? light[3] : 1.0;
    return light;
  }

  /// Turns `v` by the inverse of the rotation.
  static std::array<double, 3> turned_back(const XrQuaternionf& q, const std::array<double, 3>& v) {
    const double x = -static_cast<double>(q.x);
    const double y = -static_cast<double>(q.y);
    const double z = -static_cast<double>(q.z);
    const double w = static_cast<double>(q.w);
    const std::array<double, 3> t = {2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]),
                                     2 * (x * v[1] - y * v[0])};
    return {v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2],
            v[2] + w * t[2] + x * t[1] - y * t[0]};
  }

  const SubmittedFrame& frame_;
  int width_px_;
  int height_px_;
};

}  // namespace orthonav::test
