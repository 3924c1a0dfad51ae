#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "hal/api/object_display.h"
#include "hal/hl2ss/bytes.h"

namespace orthonav::hl2ss {

/// The commands that the Unity application accepts at its port (docs/hl2ss.md): u32 command, u32
/// size, payload. Each is answered by one u32, in order.
enum class SceneCommand : std::uint32_t {
  kCreatePrimitive = 0,
  kSetActive = 1,
  kSetWorldTransform = 2,
  kSetLocalTransform = 3,
  kSetColour = 4,
  kSetTexture = 5,
  kCreateText = 6,
  kSetText = 7,
  kSay = 8,
  kRemove = 16,
  kRemoveAll = 17,
  kBeginList = 18,
  kEndList = 19,
  kSetTargetMode = 20,
};

/// Unity's primitives by their numbers.
enum class Primitive : std::uint32_t { kSphere, kCapsule, kCylinder, kCube, kPlane, kQuad };

inline constexpr std::size_t kSceneHeaderBytes = 8;
/// The protocol sets no limit, but a larger payload stalls the frame that decodes it.
inline constexpr std::uint32_t kMaxScenePayload = std::uint32_t{1} << 20;
inline constexpr std::size_t kMaxSceneTextBytes = 256;
/// Height of capitals at font size 1 and scale 1.
inline constexpr double kCapHeightAtSizeOneM = 0.069;

void append_create(std::vector<std::uint8_t>& bytes, ObjectShape shape);
void append_active(std::vector<std::uint8_t>& bytes, std::uint32_t id, bool active);
/// In Unity's axes, which are left-handed: z mirrored.
void append_transform(std::vector<std::uint8_t>& bytes, std::uint32_t id,
                      const DisplayObject& object);
/// For a text: its content, size and colour in one command.
void append_look(std::vector<std::uint8_t>& bytes, std::uint32_t id, const DisplayObject& object);
void append_remove(std::vector<std::uint8_t>& bytes, std::uint32_t id);
/// Appends a command without payload: remove all, begin, end.
void append_plain(std::vector<std::uint8_t>& bytes, SceneCommand command);
/// A command without effect, which takes one frame outside a list: it sets the current target mode
/// again.
void append_idle(std::vector<std::uint8_t>& bytes);

/// The text as the application can show it: one line of characters in its font (`ok` for a tick),
/// without `<`, which would begin a tag, at most `kMaxSceneTextBytes` long, cut between characters.
[[nodiscard]] std::string scene_text(const std::string& text);

struct SceneMessage {
  std::uint32_t command = 0;
  Bytes payload;
  std::size_t bytes = 0;  ///< with its header
};
/// Nothing if more bytes are needed. An Error for a size beyond `kMaxScenePayload`.
Result<std::optional<SceneMessage>> read_scene_message(Bytes bytes);

}  // namespace orthonav::hl2ss
