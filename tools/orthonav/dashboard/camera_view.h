#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/mutex.h"
#include "engine/live/frame_loop.h"
#include "engine/live/rectified_camera.h"

namespace orthonav::tools {

/// The left camera's image as onlookers see it: upright in the headset's axes, rectified, as wide
/// as the image at its middle and no higher than wide. One thread.
class UprightCamera {
 public:
  explicit UprightCamera(const StereoCalibration& cameras);
  /// The image drawn into a picture of its own, valid until the next call.
  RgbaImage& picture_of(const GreyImage& left);
  [[nodiscard]] const render::View& view() const { return view_; }
  [[nodiscard]] Transform<Rig, Eye> rig_from_eye() const { return camera_.rig_from_eye(); }
  [[nodiscard]] int width_px() const { return picture_.width_px; }
  [[nodiscard]] int height_px() const { return picture_.height_px; }

 private:
  render::View view_;
  engine::RectifiedCamera camera_;
  RgbaImage picture_;
};

/// The left camera's image with the holograms over it, for onlookers. It sits between the loop and
/// the surgeon's display, which has priority and is never delayed; it draws on its own thread and
/// device, at most twice a second, and only while someone is looking.
class CameraView : public engine::LoopObserver, public engine::SnapshotSink {
 public:
  struct Onlooker {
    std::function<bool()> looks;  ///< whether someone is looking now; from any thread
    std::function<void(const RgbaImage&)> shown;  ///< on the drawing thread
  };
  /// `display` draws for the surgeon; borrowed, may be null.
  CameraView(const StereoCalibration& cameras, engine::SnapshotSink* display, Onlooker onlooker);
  ~CameraView() override;

  void pair_came(const StereoFrame& pair) override { frame_ = &pair; }
  void captured(const engine::Snapshot& snapshot) override;
  Status draw(const engine::Snapshot& snapshot) override;
  [[nodiscard]] bool stalled() const override { return display_ != nullptr && display_->stalled(); }
  /// Why nothing is drawn, once that is known: no Vulkan device. Otherwise empty.
  [[nodiscard]] std::string problem() const;

 private:
  /// The background of a snapshot's holograms.
  struct Behind {
    bool wanted = false;
    GreyImage left;
    std::optional<Transform<World, Rig>> world_from_rig;
  };
  /// Handed to the drawing thread.
  struct Moment {
    Behind behind;
    render::Scene scene;
    std::vector<engine::GlarePatch> patches;
    Timestamp display_time{};
  };
  class Drawing;

  [[nodiscard]] bool take_next(Moment& moment);
  Status draw_what_comes();

  Onlooker onlooker_;
  engine::SnapshotSink* display_;
  StereoCalibration cameras_;
  // On the tracking thread.
  const StereoFrame* frame_ = nullptr;  ///< the newest, valid until the next
  std::optional<Timestamp> taken_at_;
  /// Parallel to the loop's snapshots, slot by slot: written before a snapshot is handed over, read
  /// before it is given back.
  std::array<Behind, engine::SnapshotQueue::kSlots> behind_;

  mutable Mutex mutex_;
  ConditionVariable changed_;
  Moment next_ ORTHONAV_GUARDED_BY(mutex_);
  bool has_next_ ORTHONAV_GUARDED_BY(mutex_) = false;
  bool over_ ORTHONAV_GUARDED_BY(mutex_) = false;
  std::string problem_ ORTHONAV_GUARDED_BY(mutex_);
  std::thread thread_;
};

}  // namespace orthonav::tools
