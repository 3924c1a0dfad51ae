#include "tools/orthonav/serve_hl2ss/scene_drawing.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "base/printed.h"
#include "base/srgb.h"
#include "engine/holograms/shapes/render_values.h"
#include "engine/io/image_file.h"
#include "hal/hl2ss/scene_command.h"
#include "render/decimated.h"
#include "render/float3.h"
#include "render/shapes.h"
#include "tools/support/eye_in_rig.h"

namespace orthonav::tools {
namespace {

using hl2ss::Primitive;
using render::Float3;

// A HoloLens 2's picture for one eye.
constexpr int kWidth_px = 1440;
constexpr int kHeight_px = 936;

constexpr double kFilmScale = 0.5;
constexpr int kFilm_hz = 10;

/// Edge of Unity's plane at scale 1.
constexpr double kPlaneEdge = 10.0;

render::Colour light_of(const ObjectColour& colour) {
  const auto linear = [](float encoded) {
    return static_cast<float>(linear_from_srgb(static_cast<double>(encoded)));
  };
  return {linear(colour.r), linear(colour.g), linear(colour.b), colour.a};
}

/// Where an object's own points lie in the world.
class Placed {
 public:
  Placed(const hl2ss::UnityObject& object, const render::Head& head)
      : object_(object), rotation_(rotation_from_quaternion(object.rotation)), head_(head) {}
  [[nodiscard]] Float3 at(Vec3 own) const {
    const Vec3 scaled{own.x * object_.scale.x, own.y * object_.scale.y, own.z * object_.scale.z};
    const Float3 p = engine::to_float3(object_.position_m + rotation_ * scaled);
    return object_.on_head ? head_.position + p.x * head_.right + p.y * head_.up + p.z * head_.back
                           : p;
  }

 private:
  const hl2ss::UnityObject& object_;
  Mat3 rotation_;
  const render::Head& head_;
};

std::shared_ptr<const render::MeshData> unit_ball() {
  static const auto ball = render::prepared(render::make_sphere(0.5f));
  return ball;
}

void add_sheet(render::Scene& scene, const Placed& placed, Vec3 middle, Vec3 right, Vec3 up,
               render::Colour colour) {
  const Float3 a = placed.at(middle - 0.5 * (right + up));
  const Float3 b = placed.at(middle + 0.5 * (right - up));
  const Float3 c = placed.at(middle + 0.5 * (right + up));
  const Float3 d = placed.at(middle + 0.5 * (up - right));
  scene.triangles.push_back({kRemoteLabel, {a, b, c}, colour});
  scene.triangles.push_back({kRemoteLabel, {a, c, d}, colour});
}

void add_cube(render::Scene& scene, const Placed& placed, render::Colour colour) {
  constexpr std::array<Vec3, 3> kAxes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double side : {0.5, -0.5}) {
      add_sheet(scene, placed, side * kAxes[axis], kAxes[(axis + 1) % 3], kAxes[(axis + 2) % 3],
                colour);
    }
  }
}

/// Our texts face the eye from their anchor. A turned text is anchored at the point of its plane
/// that the eye sees at right angles, however far aside that is.
void add_text(render::Scene& scene, const hl2ss::UnityObject& object, Vec3 eye,
              render::Colour colour) {
  const Mat3 rotation = rotation_from_quaternion(object.rotation);
  const Vec3 normal = rotation.column(2);
  const Vec3 anchor = eye - (eye - object.position_m).dot(normal) * normal;
  render::TextItem& item = scene.texts.emplace_back();
  item.label = kRemoteLabel;
  item.position = engine::to_float3(anchor);
  item.place = object.on_head ? render::TextPlace::kView : render::TextPlace::kWorld;
  item.height_m =
      static_cast<float>(object.font_size * hl2ss::kCapHeightAtSizeOneM * object.scale.y);
  const Vec3 aside = (1.0 / static_cast<double>(item.height_m)) * (object.position_m - anchor);
  item.offset_right = static_cast<float>(aside.dot(rotation.column(0)));
  item.offset_up = static_cast<float>(aside.dot(rotation.column(1))) - 0.5f;
  render::TextRun& run = item.runs.emplace_back();
  run.text = object.text;
  run.colour = colour;
}

void add_object(render::Scene& scene, const hl2ss::UnityObject& object, const render::Head& head) {
  const render::Colour colour = light_of(object.colour);
  const Placed placed(object, head);
  if (object.is_text) {
    const Float3 eye = object.on_head ? Float3{} : head.position;
    return add_text(scene, object, {eye.x, eye.y, eye.z}, colour);
  }
  switch (object.primitive) {
    case Primitive::kSphere: {
      render::MeshItem& item = scene.meshes.emplace_back();
      item.label = kRemoteLabel;
      item.mesh = unit_ball();
      item.colour = colour;
      item.world_from_model = render::placed_at(placed.at({}), static_cast<float>(object.scale.x));
      return;
    }
    case Primitive::kCapsule:
    case Primitive::kCylinder: {
      render::LineItem& line = scene.lines.emplace_back();
      line.label = kRemoteLabel;
      // A line's ends are round, so they begin further inside, to cover the same area.
      const double inside = std::min(0.98, std::numbers::pi / 8 * object.scale.x / object.scale.y);
      line.points = {placed.at({0, inside - 1, 0}), placed.at({0, 1 - inside, 0})};
      line.width_m = static_cast<float>(object.scale.x);
      line.colour = colour;
      return;
    }
    case Primitive::kCube:
      return add_cube(scene, placed, colour);
    case Primitive::kPlane:
      return add_sheet(scene, placed, {}, {kPlaneEdge, 0, 0}, {0, 0, kPlaneEdge}, colour);
    case Primitive::kQuad:
      return add_sheet(scene, placed, {}, {1, 0, 0}, {0, 1, 0}, colour);
  }
}

}  // namespace

render::Scene drawn_scene(const hl2ss::UnityObjects& objects, const render::Head& head) {
  render::Scene scene;
  for (const auto& [id, object] : objects) {
    if (object.active) {
      add_object(scene, object, head);
    }
  }
  return scene;
}

Result<std::unique_ptr<SceneEye>> SceneEye::create(double scale) {
  render::RendererOptions options;
  options.width_px = static_cast<int>(kWidth_px * scale);
  options.height_px = static_cast<int>(kHeight_px * scale);
  auto renderer = render::Renderer::create(options);
  if (!renderer) {
    return renderer.error();
  }
  return std::unique_ptr<SceneEye>(new SceneEye(std::move(*renderer)));
}

Result<const RgbaImage*> SceneEye::draw(const hl2ss::UnityObjects& objects,
                                        const Transform<World, Rig>& world_from_rig) {
  const std::vector<render::View> views = {
      engine::hololens2_view(world_from_rig * rig_from_eyes())};
  const render::Scene scene = drawn_scene(objects, render::head_of(views));
  if (const Status drawn = renderer_->draw(scene, views, {}, images_); !drawn) {
    return drawn.error();
  }
  return &images_[0];
}

Result<std::unique_ptr<ScenePictures>> ScenePictures::create(const std::string& folder) {
  auto made = OutFolder::create("--draw", folder);
  if (!made) {
    return made.error();
  }
  auto eye = SceneEye::create(1.0);
  if (!eye) {
    return eye.error();
  }
  return std::unique_ptr<ScenePictures>(new ScenePictures(std::move(*made), std::move(*eye)));
}

Status ScenePictures::draw(const hl2ss::UnityObjects& objects,
                           const Transform<World, Rig>& world_from_rig) {
  const auto picture = eye_->draw(objects, world_from_rig);
  return picture ? engine::write_png(folder_.file(printed("scene-%04d.png", ++count_)), **picture)
                 : Status{picture.error()};
}

Result<std::unique_ptr<SceneFilm>> SceneFilm::create(const std::string& path) {
  auto eye = SceneEye::create(kFilmScale);
  if (!eye) {
    return eye.error();
  }
  return std::unique_ptr<SceneFilm>(new SceneFilm(path, std::move(*eye)));
}

Status SceneFilm::look(const hl2ss::UnityObjects& objects,
                       const Transform<World, Rig>& world_from_rig) {
  if (!video_) {
    if (objects.empty()) {
      return {};
    }
    engine::VideoOptions options;
    options.width_px = static_cast<int>(kWidth_px * kFilmScale);
    options.height_px = static_cast<int>(kHeight_px * kFilmScale);
    options.frames_per_second = kFilm_hz;
    auto video = engine::VideoWriter::create(path_, options);
    if (!video) {
      return video.error();
    }
    video_ = std::move(*video);
    since_first_.emplace();
  }
  const auto due = 1 + static_cast<std::int64_t>(since_first_->elapsed_ms() * 1e-3 * kFilm_hz);
  if (video_->frames() >= due) {
    return {};
  }
  const auto picture = eye_->draw(objects, world_from_rig);
  Status written = picture ? Status{} : Status{picture.error()};
  while (written && video_->frames() < due) {
    written = video_->write(**picture);
  }
  return written;
}

Status SceneFilm::finish() { return video_ ? video_->finish() : Status{}; }

}  // namespace orthonav::tools
