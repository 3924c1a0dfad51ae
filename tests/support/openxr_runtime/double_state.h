#pragma once

#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <set>

#include "tests/support/image_chain.h"
#include "tests/support/openxr_runtime/runtime_double.h"

namespace orthonav::test {

/// One image of a chain goes from free to acquired to waited for and back.
struct DoubleSwapchain {
  XrSwapchainCreateInfo info{};
  std::unique_ptr<ImageChain> chain;
  std::deque<std::uint32_t> acquired;  ///< in order
  bool waited = false;                 ///< the oldest acquired
  std::uint32_t next = 0;
  std::optional<std::uint32_t> released;  ///< last; what a layer refers to
  bool panel = false;                     ///< its images are not of the eyes' size
  std::int64_t releases = 0;
  std::int64_t read_of = -1;  ///< the release after which `pixels` were read
  std::shared_ptr<const std::vector<std::uint8_t>> pixels;
};

struct DoubleSpace {
  XrReferenceSpaceType type = XR_REFERENCE_SPACE_TYPE_LOCAL;
  bool of_gaze = false;  ///< the space of a pose action; `type` has no meaning
};

/// An action and the inputs that are bound to it.
struct DoubleAction {
  XrActionType type = XR_ACTION_TYPE_BOOLEAN_INPUT;
  std::set<XrPath> hands;  ///< its subaction paths
  std::set<std::string> bound;
};

struct DoubleTracker {
  std::size_t hand = 0;
};

struct DoubleSession {
  XrSessionState state = XR_SESSION_STATE_UNKNOWN;
  bool running = false;
  bool exit_requested = false;
  bool lost = false;
  bool waited = false;  ///< a frame was waited for but not begun
  bool begun = false;   ///< a frame was begun but not ended
  bool should_render = false;
  XrTime predicted = 0;
  VulkanObjects objects;
  std::set<DoubleSpace*> spaces;
  std::set<DoubleSwapchain*> swapchains;
  std::set<DoubleTracker*> trackers;
  bool attached = false;
};

/// A call that fails.
struct Failing {
  std::string call;
  XrResult result = XR_ERROR_RUNTIME_FAILURE;
  int times = 0;
};

/// What moved the space, and when.
struct SpaceMove {
  XrTime from = 0;
  XrPosef old_from_new{};
};

/// The one runtime of the process. C functions of OpenXR's reach it through `the_double`; each of
/// them holds the mutex except while it waits.
class Double : public RuntimeDouble {
 public:
  void reset(const RuntimeTraits& traits) override;
  void set_head(std::function<XrPosef(XrTime)> head) override;
  void set_tracked(bool valid, bool position_tracked) override;
  void press(bool down) override;
  void set_controller(bool there) override;
  void set_hand(std::size_t hand, const HandState& state) override;
  void set_gaze(const GazeState& state) override;
  void skip(int periods) override;
  void tell(XrSessionState state) override;
  void recentre(const XrPosef& old_from_new, bool known, int frames_ahead) override;
  void lose_session(bool announced) override;
  void lose_instance(bool announced) override;
  void stay_away(int attempts) override;
  void at_frame(std::int64_t number, std::function<void()> action) override;
  void fail_of_panel(const std::string& call, XrResult result, int times) override;
  [[nodiscard]] std::int64_t ended_frames() const override;
  [[nodiscard]] std::vector<SubmittedFrame> frames() const override;
  [[nodiscard]] int sessions() const override;
  [[nodiscard]] int instances() const override;
  [[nodiscard]] std::vector<std::string> violations() const override;

  /// The error that the call must return at once; XR_SUCCESS: it goes on as usual.
  XrResult fails(const char* call, bool of_panel);
  /// Writes it down and answers with the error.
  XrResult violated(const std::string& what, XrResult result);
  [[nodiscard]] XrTime now() const;
  void enter(DoubleSession& session, XrSessionState state);
  [[nodiscard]] bool is_session(XrSession handle) const;
  /// XR_SUCCESS, or why the session does not answer.
  [[nodiscard]] XrResult alive() const;
  /// The pose of the viewer in the space as it is at that time.
  [[nodiscard]] XrPosef viewer_at(XrTime time) const;
  [[nodiscard]] XrSpaceLocationFlags flags() const;

  mutable std::recursive_mutex mutex;
  RuntimeTraits traits;
  std::function<XrPosef(XrTime)> head;
  bool instance = false;
  bool instance_lost = false;
  int refusals = 0;
  bool requirements_asked = false;
  VkInstance vk_instance = VK_NULL_HANDLE;
  VkPhysicalDevice vk_physical = VK_NULL_HANDLE;
  VkDevice vk_device = VK_NULL_HANDLE;
  std::unique_ptr<DoubleSession> session;
  std::deque<XrEventDataBuffer> events;
  std::vector<SpaceMove> moves;
  XrTime stepped_now = 5'000'000'000'000'000;
  std::int64_t waited_frames = 0;
  std::int64_t ended = 0;
  std::deque<SubmittedFrame> kept;
  std::map<std::int64_t, std::function<void()>> actions;
  Failing failing;
  bool pressed = false;
  XrTime pressed_at = 0;
  std::array<HandState, 2> hands{};
  GazeState gaze;
  int skipped = 0;
  std::set<std::string> enabled;  ///< extensions
  std::set<std::unique_ptr<DoubleAction>> action_list;
  // The inputs as they were when actions were last synchronised.
  bool synced_pressed = false;
  bool synced_controller = false;
  std::array<HandState, 2> synced_hands{};
  GazeState synced_gaze;
  std::map<XrPath, std::string> paths;
  std::vector<std::string> wrong;
  int session_count = 0;
  int instance_count = 0;
};

inline constexpr const char* kHandInteraction = "XR_EXT_hand_interaction";

[[nodiscard]] Double& the_double();
/// Null if the session has no swapchain of that handle.
[[nodiscard]] DoubleSwapchain* chain_of(Double& d, XrSwapchain handle);
/// Checks the layers of a frame that is ended, and puts them into `frame`.
XrResult take_layers(Double& d, const XrFrameEndInfo& info, SubmittedFrame& frame);

/// a ∘ b of rigid poses, and the inverse.
[[nodiscard]] XrPosef multiplied(const XrPosef& a, const XrPosef& b);
[[nodiscard]] XrPosef inverse(const XrPosef& pose);

/// The function of that name; null where there is none.
[[nodiscard]] PFN_xrVoidFunction function_named(const std::string& name);
void add_instance_functions(std::map<std::string, PFN_xrVoidFunction>& table);
void add_vulkan_functions(std::map<std::string, PFN_xrVoidFunction>& table);
void add_session_functions(std::map<std::string, PFN_xrVoidFunction>& table);
void add_swapchain_functions(std::map<std::string, PFN_xrVoidFunction>& table);
void add_frame_functions(std::map<std::string, PFN_xrVoidFunction>& table);
void add_input_functions(std::map<std::string, PFN_xrVoidFunction>& table);
void add_hand_functions(std::map<std::string, PFN_xrVoidFunction>& table);

/// Reads ORTHONAV_XR_SCRIPT, if there is one, into the double; writes the reports that it asks for.
void take_script(Double& runtime);
void write_report(const Double& runtime);

template <class Function>
PFN_xrVoidFunction as_void(Function function) {
  return reinterpret_cast<PFN_xrVoidFunction>(function);
}

/// Fills an array of OpenXR's two-call idiom.
template <class T>
XrResult enumerate(const std::vector<T>& all, std::uint32_t capacity, std::uint32_t* count,
                   T* values) {
  *count = static_cast<std::uint32_t>(all.size());
  if (capacity == 0) {
    return XR_SUCCESS;
  }
  if (capacity < all.size()) {
    return XR_ERROR_SIZE_INSUFFICIENT;
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    values[i] = all[i];
  }
  return XR_SUCCESS;
}

}  // namespace orthonav::test
