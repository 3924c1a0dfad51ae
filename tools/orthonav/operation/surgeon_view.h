#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "engine/holograms/labels/label_layout.h"
#include "engine/holograms/optical_model.h"
#include "engine/live/frame_loop.h"
#include "hal/sim/cameras/room_renderer.h"
#include "hal/sim/sim_headset.h"
#include "render/renderer.h"

namespace orthonav::tools {

/// Takes composed pictures, on the rendering thread.
class PictureSink {
 public:
  virtual ~PictureSink() = default;
  virtual Status picture(const RgbaImage& image, const engine::Snapshot& snapshot) = 0;
};

/// What a HoloLens 2 shows one eye, 43° wide, four fifths as many pixels each way.
struct SurgeonViewOptions {
  int width_px = 1152;
  int height_px = 748;
  double half_angle_deg = 21.5;  ///< of the horizontal field of view
  double hand_opacity = 0.35;    ///< sim::PinholeView::hand_opacity
  std::string device;            ///< part of a Vulkan device's name; empty: the best
};

/// The surgeon's right eye's view of a simulated room: the site with the holograms added to it, as
/// in an optical see-through display. The hand is drawn as if of glass. The room is drawn from
/// where the head truly is, the holograms from where the headset believes it is: tracking error and
/// map drift appear as they would in reality. It only observes; nothing from it reaches the engine.
class SurgeonView : public engine::LoopObserver, public engine::SnapshotSink {
 public:
  /// An Error when no Vulkan device is suitable.
  static Result<std::unique_ptr<SurgeonView>> create(const SurgeonViewOptions& options);

  /// Before the loop starts. Borrowed.
  void look_at(sim::SimHeadset& headset, const sim::ErrorModel& error_model);
  /// A sink that fails, as on a full disk, gets no more pictures; this is reported on standard
  /// error.
  void send_to(PictureSink* sink) { sinks_.push_back(sink); }

  void captured(const engine::Snapshot& snapshot) override;
  Status draw(const engine::Snapshot& snapshot) override;
  [[nodiscard]] const render::DeviceInfo& device() const { return renderer_->device(); }

 private:
  struct Moment {
    sim::RoomState room;
    Tracked<Transform<World, Rig>> world_from_rig;
  };

  SurgeonView(const SurgeonViewOptions& options, std::unique_ptr<render::Renderer> renderer);
  void draw_room(const Moment& moment);
  void hand_out(const engine::Snapshot& snapshot);

  SurgeonViewOptions options_;
  std::unique_ptr<render::Renderer> renderer_;
  sim::SimHeadset* headset_ = nullptr;
  std::unique_ptr<sim::RoomRenderer> room_;
  std::vector<PictureSink*> sinks_;
  /// Parallel to the loop's snapshots, slot by slot: written before a snapshot is handed over, read
  /// before it is given back.
  std::array<Moment, engine::SnapshotQueue::kSlots> moments_;

  // Reused from picture to picture.
  RgbaImage room_picture_;
  RgbaImage background_;
  std::vector<render::View> views_;
  std::vector<const RgbaImage*> backgrounds_;
  std::vector<RgbaImage> images_;
  render::Scene drawn_;
  engine::LabelLayout labels_;
  engine::WorldBehindCombiner combiner_;
  render::Scene head_lost_;  ///< drawn while the head is not located
};

}  // namespace orthonav::tools
