#pragma once

#define XR_USE_GRAPHICS_API_VULKAN
#define XR_USE_TIMESPEC
#include <vulkan/vulkan.h>

#include <ctime>

#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace orthonav::test {

/// The properties of the runtime. Set before the application connects.
struct RuntimeTraits {
  std::vector<std::int64_t> formats = {VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_B8G8R8A8_SRGB,
                                       VK_FORMAT_R8G8B8A8_UNORM};
  std::uint32_t width_px = 160;
  std::uint32_t height_px = 120;
  std::uint32_t most_layers = 2;
  std::vector<XrEnvironmentBlendMode> blends = {XR_ENVIRONMENT_BLEND_MODE_OPAQUE,
                                                XR_ENVIRONMENT_BLEND_MODE_ADDITIVE};
  std::vector<XrReferenceSpaceType> spaces = {
      XR_REFERENCE_SPACE_TYPE_VIEW, XR_REFERENCE_SPACE_TYPE_LOCAL, XR_REFERENCE_SPACE_TYPE_STAGE};
  bool headset = true;
  bool controller = true;  ///< a khr/simple_controller in the right hand
  bool converts_time = true;
  bool takes_depth = false;      ///< `formats` has VK_FORMAT_D32_SFLOAT then
  bool valid = true;             ///< poses are known at all
  bool position_known = true;    ///< false: the headset only turns
  bool position_tracked = true;  ///< false: it is guessed
  XrVersion least_vulkan = XR_MAKE_VERSION(1, 0, 0);
  XrVersion most_vulkan = XR_MAKE_VERSION(1, 3, 0);
  std::int64_t period_ns = 10'000'000;
  /// True: time advances by a period with each frame that is waited for, and otherwise stands
  /// still.
  bool stepped = true;
  int frames_without_render = 1;  ///< at the beginning, for which shouldRender is false
  std::size_t frames_kept = 64;   ///< read back, the newest
};

/// A frame as the compositor got it.
struct SubmittedFrame {
  std::int64_t number = 0;  ///< counts ended frames from 0
  XrTime display_time = 0;
  bool should_render = true;
  std::uint32_t layers = 0;
  XrEnvironmentBlendMode blend = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
  XrCompositionLayerFlags flags = 0;
  bool on_head = false;  ///< the layer hangs on the viewer
  std::int64_t format = 0;
  std::array<XrPosef, 2> poses{};
  std::array<XrFovf, 2> fovs{};
  /// Left and right as the images hold them, four bytes a pixel, row by row; empty without a layer.
  std::array<std::vector<std::uint8_t>, 2> pixels;
  /// Distance along the view's axis, where depth was submitted; infinite where nothing is.
  std::array<std::vector<float>, 2> depth_m;
};

/// An OpenXR runtime for tests: a library that the Khronos loader loads through XR_RUNTIME_JSON. It
/// implements what the product calls, answers as the specification says, and records every use that
/// a strict runtime would not accept. All of this may be called from any thread.
class RuntimeDouble {
 public:
  virtual ~RuntimeDouble() = default;
  /// Forgets everything; nothing may be connected.
  virtual void reset(const RuntimeTraits& traits) = 0;

  /// Where the viewer is in the runtime's first space at a time; default: a gentle sway.
  virtual void set_head(std::function<XrPosef(XrTime)> head) = 0;
  virtual void set_tracked(bool valid, bool position_tracked) = 0;
  virtual void press(bool down) = 0;
  /// The session's next state. STOPPING makes the application end it; READY may follow.
  virtual void tell(XrSessionState state) = 0;
  /// The space moves this many frames from now; `old_from_new` is given to the application if
  /// `known`.
  virtual void recentre(const XrPosef& old_from_new, bool known, int frames_ahead) = 0;
  /// The loss is announced by an event, or noticed at the next call.
  virtual void lose_session(bool announced) = 0;
  virtual void lose_instance(bool announced) = 0;
  /// How many more attempts to connect fail after a loss.
  virtual void stay_away(int attempts) = 0;
  /// Does something when a frame of this number was ended, on the application's thread.
  virtual void at_frame(std::int64_t number, std::function<void()> action) = 0;

  [[nodiscard]] virtual std::int64_t ended_frames() const = 0;
  [[nodiscard]] virtual std::vector<SubmittedFrame> frames() const = 0;
  [[nodiscard]] virtual int sessions() const = 0;   ///< created so far
  [[nodiscard]] virtual int instances() const = 0;  ///< created so far
  [[nodiscard]] virtual std::vector<std::string> violations() const = 0;
};

}  // namespace orthonav::test

/// The double of the loaded library; the symbol that tests look up.
extern "C" orthonav::test::RuntimeDouble* orthonav_runtime_double();
