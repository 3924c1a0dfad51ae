#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/time.h"
#include "base/vec.h"

namespace orthonav {

// A display that is sent objects once and then draws them itself: a headset across a network, which
// keeps objects in place at its own frame rate regardless of the network.

/// At scale 1: sphere, cube and cylinder have a diameter (edge) of 1 m, the cylinder is 2 m long
/// along y; the quad is 1×1 m in xy and seen from +z; a text is centred, reads along x, upright
/// along y, and is seen from +z.
enum class ObjectShape : std::uint8_t { kSphere, kCylinder, kCube, kQuad, kText };

/// What `position_m` and `rotation` are relative to.
enum class ObjectPlace : std::uint8_t {
  kWorld,
  kHead  ///< x right, y up, -z forward
};

/// As the display takes it, each in [0, 1]. Black is transparent.
struct ObjectColour {
  float r = 1;
  float g = 1;
  float b = 1;
  float a = 1;
  friend bool operator==(const ObjectColour&, const ObjectColour&) = default;
};

struct DisplayObject {
  std::uint64_t key = 0;  ///< identifies the object from list to list; unique within a list
  ObjectShape shape = ObjectShape::kSphere;
  ObjectPlace place = ObjectPlace::kWorld;
  /// Its place or text depends on a tool's pose: hidden once `ObjectList::tool_time` is too old.
  bool follows_tool = false;
  Vec3 position_m{};
  Quaternion rotation{};
  Vec3 scale{1, 1, 1};
  ObjectColour colour;
  std::string text;           ///< UTF-8, one line; for texts only
  double cap_height_m = 0.0;  ///< for texts only
};

/// All objects to be shown, the most important first: objects beyond a limit are left out from the
/// end.
struct ObjectList {
  std::int64_t map_epoch = 0;  ///< of World (StereoFrame::map_epoch)
  /// Mid-exposure of the pair from which objects that follow a tool were computed; absent: none is
  /// shown.
  std::optional<Timestamp> tool_time;
  std::vector<DisplayObject> objects;
};

/// Statistics of the lists so far.
struct ObjectDisplayStatistics {
  std::int64_t lists = 0;  ///< sent, each as a set of differences
  std::int64_t commands = 0;
  std::int64_t bytes = 0;
  std::int64_t refused = 0;  ///< commands refused; their objects are created again
  std::int64_t connections = 0;
  std::int64_t given_up = 0;  ///< connections closed because acknowledgements stopped
  std::int64_t withheld = 0;  ///< lists whose tool guidance was too old to be sent
  std::int64_t objects = 0;   ///< on the headset now
  std::int64_t left_out = 0;  ///< of the newest list, beyond the limits
  /// From mid-exposure to the acknowledgement that the list is shown, for lists with tool guidance.
  std::vector<double> shown_age_ms;
  /// From sending a list to its acknowledgement.
  std::vector<double> acknowledged_ms;
};

/// Retains objects; given the wanted list, it computes and sends the differences. Thread-safe.
class ObjectDisplay {
 public:
  /// The display itself hides an object that follows a tool once its pair is older than this, even
  /// if it receives nothing more.
  static constexpr Duration kLongestToolAge = std::chrono::milliseconds(150);
  virtual ~ObjectDisplay() = default;
  /// Replaces the previous list. Does not wait.
  virtual void show(const ObjectList& list) = 0;
  [[nodiscard]] virtual ObjectDisplayStatistics statistics() const = 0;
};

}  // namespace orthonav
