#include "tools/orthonav/dashboard/camera_view.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "base/guarded.h"
#include "engine/holograms/labels/label_layout.h"
#include "engine/holograms/scene_builder.h"
#include "engine/holograms/shapes/render_values.h"
#include "render/renderer.h"

namespace orthonav::tools {
namespace {

constexpr int kWidth_px = 800;
constexpr Duration kTakeEvery = std::chrono::milliseconds(500);
/// The background behind holograms where the camera sees nothing.
constexpr std::array<std::uint8_t, 4> kEmpty = {34, 37, 42, 255};

/// As wide as the camera's image at its middle, no higher than wide, upright in the headset's axes.
render::View view_of(const StereoCalibration& cameras) {
  const double width = cameras.left.width_px();
  const double height = cameras.left.height_px();
  const Mat3 eye_from_camera = cameras.left_from_rig.rotation().transposed();
  render::View view;
  view.tan_left = view.tan_right = view.tan_up = view.tan_down = 0.05f;
  for (const Vec2 edge_px : {Vec2{0.5, 0.5 * height}, Vec2{width - 0.5, 0.5 * height},
                             Vec2{0.5 * width, 0.5}, Vec2{0.5 * width, height - 0.5}}) {
    const auto plane = cameras.left.unproject(edge_px);
    if (!plane) {
      continue;
    }
    const Vec3 ray = eye_from_camera * Vec3{plane->x, plane->y, 1.0};
    if (ray.z < 0.0) {
      const float across = static_cast<float>(ray.x / -ray.z);
      const float up = static_cast<float>(ray.y / -ray.z);
      view.tan_left = std::max(view.tan_left, -across);
      view.tan_right = std::max(view.tan_right, across);
      view.tan_up = std::max(view.tan_up, up);
      view.tan_down = std::max(view.tan_down, -up);
    }
  }
  // A headset's cameras look far up and down; the site lies near the middle.
  view.tan_up = std::min(view.tan_up, view.tan_left);
  view.tan_down = std::min(view.tan_down, view.tan_right);
  return view;
}

int height_px_of(const render::View& view) {
  const float ratio = (view.tan_up + view.tan_down) / (view.tan_left + view.tan_right);
  return std::clamp(static_cast<int>(static_cast<float>(kWidth_px) * ratio), 16, 2 * kWidth_px);
}

GreyImage empty_image(const StereoCalibration& cameras) {
  return {cameras.left.width_px(), cameras.left.height_px()};
}

}  // namespace

UprightCamera::UprightCamera(const StereoCalibration& cameras)
    : view_(view_of(cameras)), camera_(cameras) {
  picture_.width_px = kWidth_px;
  picture_.height_px = height_px_of(view_);
  picture_.pixels.resize(kEmpty.size() * static_cast<std::size_t>(picture_.width_px) *
                         static_cast<std::size_t>(picture_.height_px));
}

RgbaImage& UprightCamera::picture_of(const GreyImage& left) {
  for (std::size_t i = 0; i < picture_.pixels.size(); i += kEmpty.size()) {
    std::copy(kEmpty.begin(), kEmpty.end(), picture_.pixels.begin() + static_cast<long>(i));
  }
  camera_.draw(left, view_, picture_);
  return picture_;
}

/// Lives on the drawing thread.
class CameraView::Drawing {
 public:
  static Result<Drawing> create(const StereoCalibration& cameras) {
    UprightCamera camera(cameras);
    render::RendererOptions options;
    options.width_px = camera.width_px();
    options.height_px = camera.height_px();
    options.blend = render::Blend::kOver;
    auto renderer = render::Renderer::create(options);
    if (!renderer) {
      return renderer.error();
    }
    return Drawing(std::move(camera), std::move(*renderer));
  }

  Result<const RgbaImage*> picture_of(const Moment& moment) {
    const RgbaImage& background = camera_.picture_of(moment.behind.left);
    if (moment.behind.world_from_rig) {
      const auto eye_from_world =
          (*moment.behind.world_from_rig * camera_.rig_from_eye()).inverse();
      views_[0].eye_from_world = engine::to_matrix(eye_from_world.row_major());
      scene_ = moment.scene;
      labels_.lay_out(scene_, views_, moment.patches, moment.display_time);
    } else {
      engine::write_head_lost(moment.scene, scene_);
    }
    const Status drawn = renderer_->draw(scene_, views_, {&background}, images_);
    if (!drawn) {
      return drawn.error();
    }
    return &images_[0];
  }

 private:
  Drawing(UprightCamera camera, std::unique_ptr<render::Renderer> renderer)
      : camera_(std::move(camera)), renderer_(std::move(renderer)), views_(1, camera_.view()) {}

  UprightCamera camera_;
  std::unique_ptr<render::Renderer> renderer_;
  std::vector<render::View> views_;
  engine::LabelLayout labels_;
  render::Scene scene_;
  std::vector<RgbaImage> images_;
};

CameraView::CameraView(const StereoCalibration& cameras, engine::SnapshotSink* display,
                       Onlooker onlooker)
    : onlooker_(std::move(onlooker)), display_(display), cameras_(cameras) {
  // Allocated now, so that nothing is allocated while pairs arrive; images circulate between these.
  for (Behind& behind : behind_) {
    behind.left = empty_image(cameras);
  }
  next_.behind.left = empty_image(cameras);
  thread_ = std::thread([this] {
    const Status done = guarded("dashboard", [this] { return draw_what_comes(); });
    if (!done) {
      const MutexLock lock(mutex_);
      problem_ = done.error().message;
    }
  });
}

CameraView::~CameraView() {
  {
    const MutexLock lock(mutex_);
    over_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void CameraView::captured(const engine::Snapshot& snapshot) {
  Behind& behind = behind_[snapshot.slot];
  behind.wanted = frame_ != nullptr && !snapshot.blank && onlooker_.looks() &&
                  !(taken_at_ && frame_->time - *taken_at_ < kTakeEvery);
  if (!behind.wanted) {
    return;
  }
  taken_at_ = frame_->time;
  behind.left = frame_->left;
  behind.world_from_rig = frame_->world_from_rig;
}

Status CameraView::draw(const engine::Snapshot& snapshot) {
  const Status drawn = display_ != nullptr ? display_->draw(snapshot) : Status{};
  Behind& behind = behind_[snapshot.slot];
  if (!std::exchange(behind.wanted, false)) {
    return drawn;
  }
  {
    const MutexLock lock(mutex_);
    std::swap(next_.behind, behind);
    next_.scene = snapshot.scene;
    next_.patches = snapshot.patches;
    next_.display_time = snapshot.display_time;
    has_next_ = true;
  }
  changed_.notify_one();
  return drawn;
}

std::string CameraView::problem() const {
  const MutexLock lock(mutex_);
  return problem_;
}

/// False once it is over.
bool CameraView::take_next(Moment& moment) {
  const MutexLock lock(mutex_);
  while (!has_next_ && !over_) {
    changed_.wait(mutex_);
  }
  std::swap(moment, next_);
  has_next_ = false;
  return !over_;
}

Status CameraView::draw_what_comes() {
  std::optional<Drawing> drawing;  // created only once somebody looks, since a device takes a while
                                   // to start
  Moment moment;
  moment.behind.left = empty_image(cameras_);
  while (take_next(moment)) {
    if (!drawing) {
      auto made = Drawing::create(cameras_);
      if (!made) {
        return made.error();
      }
      drawing.emplace(std::move(*made));
    }
    const auto picture = drawing->picture_of(moment);
    if (!picture) {
      return picture.error();
    }
    onlooker_.shown(**picture);
  }
  return {};
}

}  // namespace orthonav::tools
