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
#include <memory>
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
  std::uint32_t most_layers = 2;  ///< of a swapchain's images
  std::uint32_t most_composition_layers = 16;
  std::vector<XrEnvironmentBlendMode> blends = {XR_ENVIRONMENT_BLEND_MODE_OPAQUE,
                                                XR_ENVIRONMENT_BLEND_MODE_ADDITIVE};
  std::vector<XrReferenceSpaceType> spaces = {
      XR_REFERENCE_SPACE_TYPE_VIEW, XR_REFERENCE_SPACE_TYPE_LOCAL, XR_REFERENCE_SPACE_TYPE_STAGE};
  bool headset = true;
  bool controller = true;         ///< a khr/simple_controller in the right hand
  bool hand_interaction = false;  ///< XR_EXT_hand_interaction, in hands that hold no controller
  bool hand_tracking = false;     ///< XR_EXT_hand_tracking
  bool eye_gaze = false;          ///< XR_EXT_eye_gaze_interaction
  bool sees_hands = true;         ///< whether the headset itself tracks hands
  bool sees_eyes = true;          ///< whether the headset itself tracks eyes
  bool converts_time = true;
  bool takes_depth = false;      ///< `formats` has VK_FORMAT_D32_SFLOAT then
  bool valid = true;             ///< poses are known at all
  bool eyes_on_head = true;      ///< where the eyes are on the head is known
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

/// A hand as the runtime sees it.
struct HandState {
  bool seen = false;
  float pinch = 0;  ///< 0 to 1, of XR_EXT_hand_interaction
  bool ready = true;
  float apart_m = 0.08f;     ///< tips of thumb and index finger, of XR_EXT_hand_tracking
  bool tips_tracked = true;  ///< false: they are guessed
};

/// Eyes as the runtime sees them.
struct GazeState {
  bool active = false;
  bool tracked = true;                     ///< false: it is guessed
  XrPosef in_viewer = {{0, 0, 0, 1}, {}};  ///< -z is where they look
  XrDuration age_ns = 5'000'000;           ///< of the newest sample
};

/// A panel as the compositor got it.
struct SubmittedQuad {
  bool on_head = false;
  XrPosef pose{};
  XrExtent2Df size{};
  XrCompositionLayerFlags flags = 0;
  std::int64_t format = 0;
  int width_px = 0;
  int height_px = 0;
  std::int64_t releases = 0;  ///< of its swapchain, so far
  /// As its image holds them, four bytes a pixel, row by row.
  std::shared_ptr<const std::vector<std::uint8_t>> pixels;
};

/// A frame as the compositor got it.
struct SubmittedFrame {
  std::int64_t number = 0;  ///< counts ended frames from 0
  XrTime display_time = 0;
  bool should_render = true;
  std::uint32_t layers = 0;
  bool has_eyes = false;              ///< a projection layer
  std::optional<SubmittedQuad> quad;  ///< laid over it
  XrEnvironmentBlendMode blend = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
  XrCompositionLayerFlags flags = 0;
  bool on_head = false;  ///< the eyes' layer hangs on the viewer
  std::int64_t format = 0;
  std::array<XrPosef, 2> poses{};
  std::array<XrFovf, 2> fovs{};
  /// Left and right as the images hold them, four bytes a pixel, row by row; empty without a layer.
  std::array<std::vector<std::uint8_t>, 2> pixels;
  /// Distance along the view's axis, where depth was submitted; infinite where nothing was drawn.
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
  virtual void set_controller(bool there) = 0;
  /// 0: left.
  virtual void set_hand(std::size_t hand, const HandState& state) = 0;
  virtual void set_gaze(const GazeState& state) = 0;
  /// Waiting for the next frame takes that many periods longer.
  virtual void skip(int periods) = 0;
  /// What the session is told next. STOPPING makes the application end it; READY may follow.
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

  /// Of the calls of that name that concern the panel or a frame with it, the next `times` fail.
  virtual void fail_of_panel(const std::string& call, XrResult result, int times) = 0;

  [[nodiscard]] virtual std::int64_t ended_frames() const = 0;
  [[nodiscard]] virtual std::vector<SubmittedFrame> frames() const = 0;
  [[nodiscard]] virtual int sessions() const = 0;   ///< created so far
  [[nodiscard]] virtual int instances() const = 0;  ///< created so far
  [[nodiscard]] virtual std::vector<std::string> violations() const = 0;
};

}  // namespace orthonav::test

/// The double of the loaded library; the symbol that tests look up.
extern "C" orthonav::test::RuntimeDouble* orthonav_runtime_double();
