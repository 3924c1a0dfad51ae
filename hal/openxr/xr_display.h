#pragma once

#include <atomic>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/mutex.h"
#include "hal/api/devices.h"
#include "hal/openxr/gaze_ray.h"
#include "hal/openxr/panel_chain.h"
#include "hal/openxr/placement.h"
#include "hal/openxr/runtime.h"
#include "hal/openxr/select_button.h"
#include "hal/openxr/session_state.h"
#include "hal/openxr/swapchains.h"

namespace orthonav::openxr {

/// How the display and the cameras are mounted relative to each other.
struct Mount {
  Placement placement = Placement::kElsewhere;
  /// The pose of the head in the cameras' rig. With cameras elsewhere: where the wearer begins.
  Transform<Rig, Viewer> rig_from_viewer;
};

/// A change of the button, by the headset's clock.
struct ButtonChange {
  bool down = false;
  Timestamp time{};
  bool lost = false;  ///< the surgeon did not let go: the input is gone
};

/// The display of an OpenXR headset: session, images, frames. The presenting thread calls the
/// functions of PixelDisplay; the others may be called from any thread, also while there is no
/// session.
class XrDisplay : public PixelDisplay {
 public:
  /// `clock` is the headset's; `cameras_head` tells where the cameras are. Both must outlive it.
  XrDisplay(const Mount& mount, const Clock& clock, const HeadTracker& cameras_head)
      : mount_(mount), clock_(clock), cameras_head_(cameras_head), anchor_(mount.placement) {}
  ~XrDisplay() override;
  XrDisplay(const XrDisplay&) = delete;
  XrDisplay& operator=(const XrDisplay&) = delete;

  Result<GraphicsNeeds> open() override;
  Result<void*> create_instance(VulkanFunction get_proc, const void* info) override;
  Result<void*> physical_device(void* instance) override;
  Result<void*> create_device(void* physical, VulkanFunction get_proc, const void* info) override;
  Result<EyeImages> start(const VulkanObjects& objects,
                          const FormatPreference& preference) override;
  DisplayFrame begin_frame() override;
  Result<std::vector<std::uint32_t>> acquire() override;
  EyeViews views() override;
  Status end_frame(const SubmittedContent& content) override;
  Result<std::uint32_t> acquire_panel() override { return panel_.acquire(); }
  Status release_panel() override { return panel_.release(); }
  void ask_to_end() override;
  void close() override;

  // Callable from any thread.
  /// "Monado(XRT) 21.0.0, Simulated HMD"; empty before the display is opened.
  [[nodiscard]] std::string name() const;
  /// Where the mounted cameras were or will be. kPredicted if the runtime has a pose without
  /// tracking, kLost if it has none.
  [[nodiscard]] Tracked<Transform<World, Rig>> world_from_rig(Timestamp at) const;
  /// Which map World belongs to at that time.
  [[nodiscard]] std::int64_t map_epoch(Timestamp at) const;
  /// From submitting a frame to its display time, as last predicted.
  [[nodiscard]] Duration latency() const { return latency_.load(); }
  /// Changes up to `until`, in order.
  void take_button(Timestamp until, std::vector<ButtonChange>& changes);

 private:
  /// The viewer's pose and how well it is known.
  struct Located {
    Transform<Space, Viewer> space_from_viewer;
    PoseStatus status = PoseStatus::kLost;
  };

  // For the presenting thread: since no other changes these, it reads them without the mutex.
  [[nodiscard]] Runtime* runtime() const ORTHONAV_NO_THREAD_SAFETY_ANALYSIS {
    return runtime_.get();
  }
  [[nodiscard]] XrSpace space() const ORTHONAV_NO_THREAD_SAFETY_ANALYSIS { return space_; }
  [[nodiscard]] XrSpace viewer() const ORTHONAV_NO_THREAD_SAFETY_ANALYSIS { return viewer_; }

  Result<GraphicsNeeds> connect();
  Result<EyeImages> make_all(const VulkanObjects& objects, const FormatPreference& preference);
  Status make_session(const VulkanObjects& objects);
  Status make_spaces();
  /// The first event that ends the session, if there is one.
  std::optional<DisplayFrame> take_events();
  std::optional<DisplayFrame> take_state(XrSessionState state);
  void take_space_change(const XrEventDataReferenceSpaceChangePending& change);
  void poll_button();
  std::optional<SelectButton::Change> poll_focused(XrTime now);
  DisplayFrame wait_and_begin();
  void take_timing(const XrFrameState& state, DisplayFrame& frame);
  /// The layer of the eyes; it points into `eyes_`.
  [[nodiscard]] XrCompositionLayerProjection eyes_layer();
  [[nodiscard]] DisplayFrame lost(const std::string& what, XrResult result);
  void lay_world(XrTime at);
  /// Writes the eyes' poses and fields of view for the frame begun into `located_` and says how
  /// well they are known.
  XrViewStateFlags locate_eyes(XrSpace space);
  /// Converts `located_`; false if a pose or a field of view can't be used.
  bool take_eyes(const Transform<World, Space>& world_from_space, EyeViews& views) const;
  bool locate_in_world(EyeViews& views);
  void locate_gaze(EyeViews& views) const;
  [[nodiscard]] Located locate_viewer(XrTime at) const ORTHONAV_REQUIRES(mutex_);
  // Converts between the runtime's clock and ours, both read now.
  [[nodiscard]] std::optional<XrTime> xr_time(Timestamp at) const ORTHONAV_REQUIRES(mutex_);
  [[nodiscard]] std::optional<Timestamp> timestamp(XrTime at) const;

  Mount mount_;
  const Clock& clock_;
  const HeadTracker& cameras_head_;
  std::atomic<Duration> latency_{std::chrono::milliseconds(20)};

  // Changed by the presenting thread under the mutex; read by other threads under it.
  mutable Mutex mutex_;
  std::unique_ptr<Runtime> runtime_ ORTHONAV_GUARDED_BY(mutex_);
  std::string headset_name_ ORTHONAV_GUARDED_BY(mutex_);
  XrSpace space_ ORTHONAV_GUARDED_BY(mutex_) = XR_NULL_HANDLE;
  XrSpace viewer_ ORTHONAV_GUARDED_BY(mutex_) = XR_NULL_HANDLE;
  WorldAnchor anchor_ ORTHONAV_GUARDED_BY(mutex_);
  std::deque<ButtonChange> button_changes_ ORTHONAV_GUARDED_BY(mutex_);

  // For the presenting thread alone.
  ViewSetup setup_;
  XrSession session_ = XR_NULL_HANDLE;
  XrReferenceSpaceType space_type_ = XR_REFERENCE_SPACE_TYPE_LOCAL;
  SessionState state_;
  bool instance_lost_ = false;  ///< or unusable: the next `open` makes a new one
  bool had_session_ = false;
  bool end_asked_ = false;
  Swapchains swapchains_;
  PanelChain panel_;
  double near_m_ = 0.0;  ///< distance at which depth is 0
  HeadsetTraits traits_;
  Actions actions_;
  HandJoints joints_;
  GazeRay gaze_;
  SelectButton button_;
  XrTime display_time_ = 0;  ///< of the frame that was begun; 0: none since the session began
  std::array<XrView, 2> located_{};
  XrSpace located_in_ = XR_NULL_HANDLE;
  // The eyes' layer of a submitted frame points to these.
  std::array<XrCompositionLayerProjectionView, 2> eyes_{};
  std::array<XrCompositionLayerDepthInfoKHR, 2> depths_{};
};

}  // namespace orthonav::openxr
