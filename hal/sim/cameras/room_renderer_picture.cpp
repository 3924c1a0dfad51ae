#include "hal/sim/cameras/room_renderer_picture.h"

#include <algorithm>
#include <cmath>

#include "base/srgb.h"

namespace orthonav::sim {
namespace {

constexpr int kDefaultWidthPx = 960;
constexpr int kDefaultHeightPx = 540;
/// Pictures for people are brighter than the cameras' images: paper is nearly white.
constexpr float kPrintLight = 1.2F;
constexpr std::size_t kEncodeSteps = 4096;

/// Eye axes (y up, -z forward) to camera axes (y down, z forward).
Transform<LeftCamera, Room> camera_from_room_of(const PinholeView& view) {
  const Transform<LeftCamera, Eye> camera_from_eye{{{{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}}}, {}};
  return camera_from_eye * view.room_from_eye.inverse();
}

std::uint8_t encoded(float linear) {
  const double v = static_cast<double>(std::clamp(linear, 0.0F, 1.0F));
  return static_cast<std::uint8_t>(std::lround(255.0 * srgb_from_linear(v)));
}

using Colour = std::array<float, 3>;

/// As on the two sides of an edge.
bool far_apart(const Colour& a, const Colour& b) {
  constexpr float kFar = 0.08F;
  return std::abs(a[0] - b[0]) > kFar || std::abs(a[1] - b[1]) > kFar ||
         std::abs(a[2] - b[2]) > kFar;
}

Colour bone_colour(float lit, float height) {
  // Blood stays in the grooves near the tissue.
  const float clean = std::clamp((height - 0.0005F) / 0.005F, 0.0F, 1.0F);
  // Light that bone and tissue throw at each other fills what the lamp does not reach.
  const float light = 0.10F + 0.95F * std::pow(std::max(lit, 0.0F), 0.8F);
  return {light * (0.42F + 0.42F * clean), light * (0.13F + 0.60F * clean),
          light * (0.08F + 0.44F * clean)};
}

/// Moves the hand's bodies to `hand`.
void take_hand(Solids& solids, Solids& hand) {
  hand.lamp_in_camera = solids.lamp_in_camera;
  const auto is_tool = [](const Capsule& capsule) { return capsule.tool >= 0; };
  const auto first = std::stable_partition(solids.capsules.begin(), solids.capsules.end(), is_tool);
  hand.capsules.assign(first, solids.capsules.end());
  solids.capsules.erase(first, solids.capsules.end());
}

}  // namespace

/// The ground as the rays of a picture meet it.
struct PicturePainter::GroundView {
  const Ground& ground;
  const PinholeLens& lens;
  Transform<Spine, LeftCamera> spine_from_camera;

  /// At a place in pixels; the corner of the picture is (0, 0).
  [[nodiscard]] Colour colour(Vec2 at, float* nearness = nullptr) const {
    const Vec3 eye = spine_from_camera.translation();
    const Vec3 ray = spine_from_camera.rotation() * lens.ray(at);
    const Colour direction{static_cast<float>(ray.x), static_cast<float>(ray.y),
                           static_cast<float>(ray.z)};
    const Ground::Hit hit = ground.hit(
        {static_cast<float>(eye.x), static_cast<float>(eye.y), static_cast<float>(eye.z)},
        direction);
    if (nearness != nullptr) {
      *nearness = hit.distance > 0.0F ? 1.0F / hit.distance : 0.0F;
    }
    return ground.colour(hit, direction);
  }
  /// The mean over a pixel, of four places; `corner` is its upper left one.
  [[nodiscard]] Colour finely(Vec2 corner) const {
    Colour mean{};
    for (const Vec2 offset : {Vec2{0.25, 0.25}, {0.75, 0.25}, {0.25, 0.75}, {0.75, 0.75}}) {
      const Colour one = colour(corner + offset);
      for (std::size_t k = 0; k < 3; ++k) {
        mean[k] += 0.25F * one[k];
      }
    }
    return mean;
  }
};

PicturePainter::PicturePainter(const RoomDescription& room, const Ground& ground)
    : ground_(ground), bones_(room, ground, 0.0) {
  for (std::size_t i = 0; i < kEncodeSteps; ++i) {
    encode_.push_back(encoded(static_cast<float>(i) / (kEncodeSteps - 1)));
  }
}

/// At half the resolution.
void PicturePainter::paint_coarse_ground(const GroundView& ground) {
  const int columns = (width_ + 1) / 2;
  const int rows = (height_ + 1) / 2;
  coarse_.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  coarse_nearness_.resize(coarse_.size());
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const std::size_t at = static_cast<std::size_t>(j * columns + i);
      coarse_[at] = ground.colour({2.0 * i + 1.0, 2.0 * j + 1.0}, &coarse_nearness_[at]);
    }
  }
}

void PicturePainter::paint_ground(const GroundView& ground) {
  paint_coarse_ground(ground);
  const int columns = (width_ + 1) / 2;
  const int rows = (height_ + 1) / 2;
  light_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  nearness_.resize(light_.size());
  for (int y = 0; y < height_; ++y) {
    const int low = std::max((y + 1) / 2 - 1, 0);
    const int high = std::min((y + 1) / 2, rows - 1);
    const float t = y % 2 == 0 ? 0.75F : 0.25F;
    for (int x = 0; x < width_; ++x) {
      const int left = std::max((x + 1) / 2 - 1, 0);
      const int right = std::min((x + 1) / 2, columns - 1);
      const float s = x % 2 == 0 ? 0.75F : 0.25F;
      const Colour& a = coarse_[static_cast<std::size_t>(low * columns + left)];
      const Colour& b = coarse_[static_cast<std::size_t>(low * columns + right)];
      const Colour& c = coarse_[static_cast<std::size_t>(high * columns + left)];
      const Colour& d = coarse_[static_cast<std::size_t>(high * columns + right)];
      Colour& out = light_[static_cast<std::size_t>(y * width_ + x)];
      if (far_apart(a, d) || far_apart(b, c)) {
        out = ground.finely({static_cast<double>(x), static_cast<double>(y)});
      } else {
        for (std::size_t k = 0; k < 3; ++k) {
          out[k] = (1 - t) * ((1 - s) * a[k] + s * b[k]) + t * ((1 - s) * c[k] + s * d[k]);
        }
      }
      nearness_[static_cast<std::size_t>(y * width_ + x)] =
          coarse_nearness_[static_cast<std::size_t>((y / 2) * columns + x / 2)];
    }
  }
}

void PicturePainter::paint_bones(const PinholeLens& lens,
                                 const Transform<LeftCamera, Spine>& camera_from_spine) {
  bone_image_.reset(width_, height_);
  bone_image_.draw(bones_, ground_, camera_from_spine, lens, 1.0);
  for (int y = bone_image_.low_row(); y < bone_image_.high_row(); ++y) {
    for (int x = 0; x < width_; ++x) {
      const std::size_t i = static_cast<std::size_t>(y * width_ + x);
      if (bone_image_.nearness()[i] <= 0.0F) {
        continue;
      }
      light_[i] = bone_colour(bone_image_.lit()[i], bone_image_.height()[i]);
      nearness_[i] = bone_image_.nearness()[i];
    }
  }
}

void PicturePainter::encode_light(RgbaImage& image) const {
  for (std::size_t i = 0; i < light_.size(); ++i) {
    std::uint8_t* out = image.pixels.data() + 4 * i;
    for (std::size_t k = 0; k < 3; ++k) {
      out[k] = encode_[static_cast<std::size_t>(std::clamp(light_[i][k], 0.0F, 1.0F) *
                                                static_cast<float>(kEncodeSteps - 1))];
    }
    out[3] = 255;
  }
}

/// Bodies carry greys as a display shows them, so they are laid over the encoded background.
void PicturePainter::lay_over(const Foreground& bodies, float opacity, RgbaImage& image) {
  const std::size_t plane = bodies.plane();
  for (int y = 0; y < image.height_px; ++y) {
    const CoverageWindow::Span span = bodies.spans[static_cast<std::size_t>(y)];
    for (int x = std::max(span.low, 0); x < std::min(span.high, image.width_px); ++x) {
      const std::size_t at = bodies.row(y) + static_cast<std::size_t>(x);
      std::uint8_t* out = image.pixels.data() + 4 * at;
      for (std::size_t k = 0; k < 3; ++k) {
        const float below = static_cast<float>(out[k]);
        const float v = below + opacity * (kPrintLight * bodies.light[k * plane + at] -
                                           bodies.opacity[at] * below);
        out[k] = static_cast<std::uint8_t>(std::clamp(v + 0.5F, 0.0F, 255.0F));
      }
    }
  }
}

void PicturePainter::paint(const RoomState& state, const PinholeView& view,
                           const ToolBodies& bodies, RgbaImage& image) {
  if (image.width_px <= 0 || image.height_px <= 0) {
    image.width_px = kDefaultWidthPx;
    image.height_px = kDefaultHeightPx;
  }
  width_ = image.width_px;
  height_ = image.height_px;
  image.pixels.resize(4 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  const PinholeLens lens(view, width_, height_);
  const Transform<LeftCamera, Room> camera_from_room = camera_from_room_of(view);
  const Transform<LeftCamera, Spine> camera_from_spine = camera_from_room * state.room_from_spine;
  paint_ground({ground_, lens, camera_from_spine.inverse()});
  paint_bones(lens, camera_from_spine);
  foreground_.reset(width_, height_, 3);
  bodies.gather(state, camera_from_room, solids_, 0.0);
  encode_light(image);
  if (view.hand_opacity < 1.0) {
    // Under the tools, as glass: it hides neither them nor what they point at.
    take_hand(solids_, hand_solids_);
    hand_.reset(width_, height_, 3);
    layers_.add_moment(hand_solids_, lens, 1.0F, hand_, nearness_.data());
    lay_over(hand_, static_cast<float>(view.hand_opacity), image);
  }
  layers_.add_moment(solids_, lens, 1.0F, foreground_, nearness_.data());
  lay_over(foreground_, 1.0F, image);
}

}  // namespace orthonav::sim
