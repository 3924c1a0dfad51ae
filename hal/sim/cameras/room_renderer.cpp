#include "hal/sim/cameras/room_renderer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hal/sim/cameras/room_renderer_room.h"
#include "hal/sim/room/tag_flaws.h"

namespace orthonav::sim {
namespace {

/// Thins the bones to about a pixel of the background at arm's length.
constexpr double kCoarseCellM = 0.0025;

/// Doubles the resolution: value i of the source belongs to value 2i+1 of the target.
void doubled(const HalfImage& from, HalfImage& to) {
  for (int y = 0; y < to.height; ++y) {
    const int j = std::min((y + 1) / 2, from.height - 1);
    const int i = std::max((y + 1) / 2 - 1, 0);
    const float lower = y % 2 == 0 ? 0.75F : 0.25F;
    const float* top = from.row(i);
    const float* bottom = from.row(j);
    float* out = to.grey.data() + static_cast<std::ptrdiff_t>(y) * to.width;
    float before = top[0] + lower * (bottom[0] - top[0]);
    out[0] = before;
    int x = 1;
    for (int k = 1; k < from.width; ++k) {
      const float here = top[k] + lower * (bottom[k] - top[k]);
      if (x < to.width) {
        out[x++] = 0.75F * before + 0.25F * here;
      }
      if (x < to.width) {
        out[x++] = 0.25F * before + 0.75F * here;
      }
      before = here;
    }
    for (; x < to.width; ++x) {
      out[x] = before;
    }
  }
}

/// Fills the quarter-size background point by point.
struct GroundPoints {
  const Ground& ground;
  const CameraLens& lens;
  const Transform<Spine, LeftCamera>& spine_from_camera;
  HalfImage& grey;
  std::vector<Ground::Kind>& kinds;

  [[nodiscard]] std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j * grey.width + i);
  }
  void look(int i, int j) const {
    const Vec3 ray =
        spine_from_camera.rotation() * lens.ray(std::min(4 * i + 2, lens.width_px() - 1),
                                                std::min(4 * j + 2, lens.height_px() - 1));
    const std::size_t at = index(i, j);
    grey.grey[at] = 0.0F;
    kinds[at] = Ground::Kind::kNothing;
    if (std::isnan(ray.x)) {
      return;
    }
    const Vec3 eye = spine_from_camera.translation();
    const Ground::Hit hit = ground.hit(
        {static_cast<float>(eye.x), static_cast<float>(eye.y), static_cast<float>(eye.z)},
        {static_cast<float>(ray.x), static_cast<float>(ray.y), static_cast<float>(ray.z)});
    grey.grey[at] = ground.grey(hit);
    kinds[at] = hit.kind;
  }
  /// The mean of the neighbours at ±(di, dj) where both are plain cloth or floor.
  void fill(int i, int j, int di, int dj) const {
    if (i + di >= grey.width || j + dj >= grey.height) {
      return look(i, j);
    }
    const std::size_t a = index(i - di, j - dj);
    const std::size_t b = index(i + di, j + dj);
    if (kinds[a] != kinds[b] ||
        (kinds[a] != Ground::Kind::kDrape && kinds[a] != Ground::Kind::kFloor)) {
      return look(i, j);
    }
    const std::size_t at = index(i, j);
    grey.grey[at] = 0.5F * (grey.grey[a] + grey.grey[b]);
    kinds[at] = kinds[a];
  }
};

}  // namespace

std::unique_ptr<RoomRenderer> RoomRenderer::create(RoomDescription room,
                                                   const ErrorModel& error_model) {
  return std::make_unique<SoftwareRoomRenderer>(std::move(room), error_model);
}

SoftwareRoomRenderer::SoftwareRoomRenderer(RoomDescription room, const ErrorModel& error_model)
    : room_(std::move(room)),
      ground_(room_),
      coarse_bones_(room_, ground_, kCoarseCellM),
      error_model_(error_model),
      bodies_(room_),
      sensor_(error_model),
      painter_(room_, ground_) {}

void SoftwareRoomRenderer::draw_ground(const CameraLens& lens,
                                       const Transform<Spine, LeftCamera>& spine_from_camera) {
  kinds_.resize(quarter_.grey.size());
  const GroundPoints points{ground_, lens, spine_from_camera, quarter_, kinds_};
  // Every second point first; those in between only where something other than plain cloth is near.
  for (int j = 0; j < quarter_.height; j += 2) {
    for (int i = 0; i < quarter_.width; i += 2) {
      points.look(i, j);
    }
  }
  for (int j = 0; j < quarter_.height; j += 2) {
    for (int i = 1; i < quarter_.width; i += 2) {
      points.fill(i, j, 1, 0);
    }
  }
  for (int j = 1; j < quarter_.height; j += 2) {
    for (int i = 0; i < quarter_.width; ++i) {
      points.fill(i, j, 0, 1);
    }
  }
}

void SoftwareRoomRenderer::draw_background(const CameraLens& lens,
                                           const Transform<LeftCamera, Spine>& camera_from_spine) {
  background_.reset((lens.width_px() + 1) / 2, (lens.height_px() + 1) / 2);
  quarter_.reset((background_.width + 1) / 2, (background_.height + 1) / 2);
  draw_ground(lens, camera_from_spine.inverse());
  doubled(quarter_, background_);
  bone_image_.reset(background_.width, background_.height);
  bone_image_.draw(coarse_bones_, ground_, camera_from_spine, lens, 0.5);
  for (int y = bone_image_.low_row(); y < bone_image_.high_row(); ++y) {
    for (int x = 0; x < background_.width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y * background_.width + x);
      if (bone_image_.nearness()[i] > 0.0F) {
        background_.grey[i] = 68.0F + 92.0F * bone_image_.lit()[i];
      }
    }
  }
}

void SoftwareRoomRenderer::render(std::span<const RoomState> states, const CameraModel& camera,
                                  const Transform<LeftCamera, Rig>& camera_from_rig,
                                  std::uint64_t noise_seed, GreyImage& image) {
  image.width_px = camera.width_px();
  image.height_px = camera.height_px();
  if (states.empty() || camera.lookup().empty()) {  // a bug of the caller; the image stays black
    image.pixels.assign(camera.lookup().size(), 0);
    return;
  }
  const CameraLens lens(camera);
  const RoomState& middle = states[states.size() / 2];
  draw_background(lens, camera_from_rig * middle.room_from_rig.inverse() * middle.room_from_spine);
  foreground_.reset(camera.width_px(), camera.height_px(), 1);
  for (const RoomState& state : states) {
    bodies_.gather(state, camera_from_rig * state.room_from_rig.inverse(), solids_,
                   error_model_.tag_gloss);
    layers_.add_moment(solids_, lens, 1.0F / static_cast<float>(states.size()), foreground_);
  }
  const double lamp = flicker(error_model_, seconds(middle.time.time_since_epoch()));
  sensor_.expose(background_, foreground_, noise_seed, static_cast<float>(lamp), image);
}

void SoftwareRoomRenderer::picture(const RoomState& state, const PinholeView& view,
                                   RgbaImage& image) {
  painter_.paint(state, view, bodies_, image);
}

}  // namespace orthonav::sim
