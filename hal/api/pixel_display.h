#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/tracked.h"
#include "base/transform.h"

namespace orthonav {

// A display that takes pixels straight from the device that draws them: a headset's runtime, which
// makes that device, owns the images and says when they are wanted. Vulkan's handles pass as plain
// pointers and numbers (docs/decisions/0034-draw-on-the-runtimes-device.md).

/// Any function of Vulkan's; cast to what it is by who calls it.
using GraphicsFunction = void (*)();

/// How the display puts pixels over the world.
enum class WorldBlend {
  kAdditive,  ///< optical see-through: light is added, alpha counts for nothing
  kAlpha,     ///< over the cameras' view, premultiplied by alpha
  kOpaque     ///< instead of the world: what is black is black
};

struct GraphicsVersion {
  std::uint32_t major = 0;
  std::uint32_t minor = 0;
};

/// What the display wants of who draws, before there is a device.
struct GraphicsNeeds {
  std::array<GraphicsVersion, 2> vulkan{};  ///< the least and the most
  WorldBlend blend = WorldBlend::kOpaque;
};

/// The device that draws.
struct GraphicsObjects {
  void* instance = nullptr;  ///< VkInstance
  void* physical = nullptr;  ///< VkPhysicalDevice
  void* device = nullptr;    ///< VkDevice
  std::uint32_t queue_family = 0;
  std::uint32_t queue_index = 0;
};

/// Images to draw into. A chain is a ring of images of which one is free at a time.
struct EyeImages {
  std::int64_t format = 0;  ///< VkFormat
  int width_px = 0;
  int height_px = 0;
  std::uint32_t layers = 1;  ///< 2: one chain for both eyes; 1: a chain an eye
  std::vector<std::vector<std::uint64_t>> chains;  ///< VkImage, single sample
  /// Where the display asks how far things are: chains like the others, or none.
  std::int64_t depth_format = 0;
  std::vector<std::vector<std::uint64_t>> depth_chains;
};

/// Says of a VkFormat how well it suits who draws, 0 not at all; and whether he takes two layers.
class FormatPreference {
 public:
  virtual ~FormatPreference() = default;
  [[nodiscard]] virtual int format_score(std::int64_t format) const = 0;
  /// The same of depth, which is 0 at `near_m` and 1 at infinity.
  [[nodiscard]] virtual int depth_format_score(std::int64_t format) const = 0;
  [[nodiscard]] virtual double near_m() const = 0;
  [[nodiscard]] virtual bool takes_layers() const = 0;
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

/// Both eyes, left first. With `kLost` nothing may be drawn that has a place in the world.
struct EyeViews : Tracked<std::array<EyeView, 2>> {
  /// With `kLost`: where the eyes are on the head is known still, and World in `value` is the head,
  /// so that what it carries may be drawn. Else `value` says nothing.
  bool on_head = false;
};

/// What the display wants next.
struct DisplayFrame {
  enum class Kind {
    kFrame,  ///< a frame was begun: `end_frame` must follow
    kIdle,   ///< nobody looks; ask again in a moment
    kLost,   ///< session or runtime are gone: `close`, then `open` again
    kOver    ///< the user ended it: `close`
  };
  Kind kind = Kind::kIdle;
  bool draw = false;         ///< false: the frame is not shown, and nothing needs to be drawn
  Timestamp display_time{};  ///< when the frame lights up, by the headset's clock
  std::string why;           ///< of kLost and kOver, one line
};

/// One thread at a time, always the same between `start` and `close`: the one that submits to the
/// device's queue. Nothing but `begin_frame` and `acquire` waits, and these for a frame at the
/// most.
class PixelDisplay {
 public:
  virtual ~PixelDisplay() = default;

  /// Connects with the runtime; again after a loss. The calls that follow, in this order, make the
  /// device and the images.
  virtual Result<GraphicsNeeds> open() = 0;
  /// A VkInstance by a VkInstanceCreateInfo, for the caller to destroy.
  virtual Result<void*> create_instance(GraphicsFunction get_instance_proc_addr,
                                        const void* info) = 0;
  virtual Result<void*> physical_device(void* instance) = 0;
  /// A VkDevice by a VkDeviceCreateInfo, for the caller to destroy after `close`.
  virtual Result<void*> create_device(void* physical, GraphicsFunction get_instance_proc_addr,
                                      const void* info) = 0;
  virtual Result<EyeImages> start(const GraphicsObjects& objects,
                                  const FormatPreference& preference) = 0;

  virtual DisplayFrame begin_frame() = 0;
  /// Which image of each chain to draw this frame into, those of depth after the others.
  virtual Result<std::vector<std::uint32_t>> acquire() = 0;
  /// Where the eyes will be when the frame begun lights up, as known this moment.
  virtual EyeViews views() = 0;
  /// Hands the frame over: with what was drawn for the newest `views`, or without anything.
  virtual Status end_frame(bool drawn) = 0;

  /// Asks the runtime to end the session in order; `begin_frame` goes on until it says kOver.
  virtual void ask_to_end() = 0;
  /// Lets go of images and session; what draws must be done with them.
  virtual void close() = 0;
};

}  // namespace orthonav
