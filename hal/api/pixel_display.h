#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/tracked.h"
#include "base/transform.h"
#include "base/vulkan_handover.h"
#include "hal/api/gaze.h"

namespace orthonav {

// A display that takes pixels directly from the device that draws them: a headset's runtime, which
// makes that device, owns the images and says when it needs them.

/// How the display puts pixels over the world.
enum class WorldBlend {
  kAdditive,  ///< optical see-through: light is added, alpha has no effect
  kAlpha,     ///< over the cameras' view, premultiplied by alpha
  kOpaque     ///< instead of the world: black is shown as black
};

/// The display's requirements on the renderer before there is a device.
struct GraphicsNeeds {
  std::array<VulkanVersion, 2> vulkan{};  ///< the oldest and the newest that it takes
  WorldBlend blend = WorldBlend::kOpaque;
};

/// The renderer's preferences among image formats: a score for each VkFormat (higher is better, 0:
/// it can't draw into such images).
class FormatPreference {
 public:
  virtual ~FormatPreference() = default;
  [[nodiscard]] virtual int format_score(std::int64_t format) const = 0;
  /// The same for depth, which is 0 at `near_m` and 1 at infinity.
  [[nodiscard]] virtual int depth_format_score(std::int64_t format) const = 0;
  [[nodiscard]] virtual double near_m() const = 0;
  /// Width and height of the images of a panel, if the display has one.
  [[nodiscard]] virtual std::array<int, 2> panel_px() const = 0;
};

/// Where a panel hangs: on the head, upright, facing the point between the eyes.
struct HeadPanel {
  Vec3 middle_m;  ///< from the point between the eyes: x right, y up, z backward
  double width_m = 0.0;
  double height_m = 0.0;
};

/// What is submitted with a frame; what is left out is not shown.
struct SubmittedContent {
  bool eyes = false;               ///< what was drawn for the newest `views`
  std::optional<HeadPanel> panel;  ///< where the newest released image of the panel is shown
};

/// One eye at the moment of display. Tangents of the half angles, positive where the axis lies
/// inside the field of view.
struct EyeView {
  Transform<World, Eye> world_from_eye;
  double tan_left = 0.0;
  double tan_right = 0.0;
  double tan_up = 0.0;
  double tan_down = 0.0;
};

/// Both eyes, left first. With `kLost` nothing placed in the world may be drawn.
struct EyeViews : Tracked<std::array<EyeView, 2>> {
  /// With `kLost`: true if the eyes' places on the head are still known. World in `value` is then
  /// the head, and items fixed to the head may be drawn. If false, `value` is meaningless.
  bool on_head = false;
  /// Where the eyes look; absent if no eye tracker sees them or its newest sample is older than
  /// 100 ms.
  std::optional<Gaze> gaze;
};

/// What the display wants next.
struct DisplayFrame {
  enum class Kind {
    kFrame,  ///< a frame has begun: `end_frame` must follow
    kIdle,   ///< the display is not being viewed; ask again in a moment
    kLost,   ///< the session or the runtime is gone: `close`, then `open` again
    kOver    ///< the user ended the session: `close`
  };
  Kind kind = Kind::kIdle;
  bool draw = false;         ///< false: the frame is not shown, and nothing needs to be drawn
  Timestamp display_time{};  ///< when the frame is shown, by the headset's clock
  Duration ahead{};          ///< from now until then
  Duration period{};         ///< between two frames; 0: not known
  /// How many display periods since the previous frame had no frame of ours.
  std::int64_t missed = 0;
  std::string why;  ///< of kLost and kOver, one line
};

/// One thread at a time, always the same between `start` and `close`: the one that submits to the
/// device's queue. Only `begin_frame` and `acquire` wait, and for no longer than a frame.
class PixelDisplay {
 public:
  virtual ~PixelDisplay() = default;

  /// Connects to the runtime, also again after a loss. The calls below, in this order, then make
  /// the device and the images.
  virtual Result<GraphicsNeeds> open() = 0;
  /// A VkInstance as described by a VkInstanceCreateInfo; the caller destroys it.
  virtual Result<void*> create_instance(VulkanFunction get_instance_proc_addr,
                                        const void* info) = 0;
  virtual Result<void*> physical_device(void* instance) = 0;
  /// A VkDevice as described by a VkDeviceCreateInfo; the caller destroys it after `close`.
  virtual Result<void*> create_device(void* physical, VulkanFunction get_instance_proc_addr,
                                      const void* info) = 0;
  virtual Result<EyeImages> start(const VulkanObjects& objects,
                                  const FormatPreference& preference) = 0;

  virtual DisplayFrame begin_frame() = 0;
  /// Which image of each chain to draw this frame into, the chains of depth after the others.
  virtual Result<std::vector<std::uint32_t>> acquire() = 0;
  /// Where the eyes will be at the display time of the frame begun, as predicted now.
  virtual EyeViews views() = 0;
  /// Submits the frame. After an Error the display may no longer have a panel.
  virtual Status end_frame(const SubmittedContent& content) = 0;

  /// Which image of the panel to draw into, if `start` gave it images. Does not wait: an Error if
  /// none is free now or the display no longer has a panel. The panel shows its previous image
  /// until `release_panel`.
  virtual Result<std::uint32_t> acquire_panel() = 0;
  /// Returns the acquired image, drawn into; the panel shows it until the next one is released.
  virtual Status release_panel() = 0;

  /// Asks the runtime to end the session in an orderly way; keep calling `begin_frame` until it
  /// returns kOver.
  virtual void ask_to_end() = 0;
  /// Releases images and session; the renderer must be done with them.
  virtual void close() = 0;
};

}  // namespace orthonav
