#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "base/vec.h"
#include "hal/api/object_display.h"
#include "hal/hl2ss/bytes.h"
#include "hal/hl2ss/scene_command.h"

namespace orthonav::hl2ss {

/// One object in the application, in our axes: right-handed, -z forward.
struct UnityObject {
  bool is_text = false;
  Primitive primitive = Primitive::kQuad;
  bool active = false;
  bool on_head = false;
  Vec3 position_m{};
  Quaternion rotation{0, 0, 0, 1};
  Vec3 scale{1, 1, 1};
  ObjectColour colour;
  std::string text;
  double font_size = 0.0;
};
using UnityObjects = std::map<std::uint32_t, UnityObject>;

/// Simulates how the Unity application processes its messages: they wait in a queue; each frame
/// processes one, or, within a display list, all that have arrived. No sockets, no clock.
class UnityScene {
 public:
  void add(const SceneMessage& message);
  /// The client disconnected: its messages are processed, then the modes are reset.
  void client_left();
  /// Processes one frame and appends the answers.
  void run_frame(std::vector<std::uint32_t>& answers);
  [[nodiscard]] bool is_idle() const { return queue_.empty(); }
  [[nodiscard]] const UnityObjects& objects() const { return objects_; }
  /// The next commands that need an object, this many, are answered 0 and do nothing.
  void refuse_next(int commands) { to_refuse_ += commands; }

 private:
  struct Waiting {
    std::uint32_t command = 0;
    std::vector<std::uint8_t> payload;
    bool leaves = false;
  };
  [[nodiscard]] std::uint32_t execute(const Waiting& message);
  [[nodiscard]] std::uint32_t create(bool is_text, Primitive primitive);
  [[nodiscard]] std::uint32_t change(SceneCommand command, Bytes payload);
  [[nodiscard]] UnityObject* target(std::uint32_t id);

  std::deque<Waiting> queue_;
  UnityObjects objects_;
  bool in_list_ = false;
  bool targets_last_ = false;
  std::uint32_t last_created_ = 0;
  std::uint32_t next_id_ = 0xFFFF'F000u;  ///< Unity gives negative ids to objects made at run time
  int to_refuse_ = 0;
};

}  // namespace orthonav::hl2ss
