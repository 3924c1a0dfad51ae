#include "hal/hl2ss/scene_command.h"

#include <array>
#include <string_view>
#include <utility>

namespace orthonav::hl2ss {
namespace {

void append_header(std::vector<std::uint8_t>& bytes, SceneCommand command, std::size_t size) {
  append(bytes, static_cast<std::uint32_t>(command));
  append(bytes, static_cast<std::uint32_t>(size));
}

Primitive primitive_of(ObjectShape shape) {
  switch (shape) {
    case ObjectShape::kSphere:
      return Primitive::kSphere;
    case ObjectShape::kCylinder:
      return Primitive::kCylinder;
    case ObjectShape::kCube:
      return Primitive::kCube;
    case ObjectShape::kQuad:
    case ObjectShape::kText:
      break;
  }
  return Primitive::kQuad;
}

void append_floats(std::vector<std::uint8_t>& bytes, std::initializer_list<double> numbers) {
  for (const double number : numbers) {
    append(bytes, static_cast<float>(number));
  }
}

void append_colour(std::vector<std::uint8_t>& bytes, const ObjectColour& colour) {
  append_floats(bytes, {colour.r, colour.g, colour.b, colour.a});
}

/// The application's font contains ASCII and Latin-1, and `<` begins a tag.
constexpr std::array<std::pair<std::string_view, std::string_view>, 14> kWrittenAs = {{
    {"<", "\u00AB"},
    {"\u2212", "-"},  // minus
    {"\u2264", "max"},
    {"\u2265", "min"},
    {"\u2012", "-"},  // a hyphen as wide as a digit
    {"\u2007", " "},  // a blank as wide as a digit
    {"\u2026", "..."},
    {"\u2713", "ok"},
    {"\u2717", "x"},
    {"\u25C6", "+"},  // a part of a bar, filled
    {"\u25C7", "-"},  // or not
    {"\u25CF", "*"},  // measured,
    {"\u25D0", "~"},  // predicted,
    {"\u25CB", "o"},  // lost
}};

std::string_view written(std::string_view character) {
  for (const auto& [from, to] : kWrittenAs) {
    if (character == from) {
      return to;
    }
  }
  return static_cast<unsigned char>(character.front()) < 0x20u ? " " : character;
}

}  // namespace

void append_create(std::vector<std::uint8_t>& bytes, ObjectShape shape) {
  if (shape == ObjectShape::kText) {
    return append_header(bytes, SceneCommand::kCreateText, 0);
  }
  append_header(bytes, SceneCommand::kCreatePrimitive, 4);
  append(bytes, static_cast<std::uint32_t>(primitive_of(shape)));
}

void append_active(std::vector<std::uint8_t>& bytes, std::uint32_t id, bool active) {
  append_header(bytes, SceneCommand::kSetActive, 8);
  append(bytes, id);
  append(bytes, std::uint32_t{active ? 1u : 0u});
}

void append_transform(std::vector<std::uint8_t>& bytes, std::uint32_t id,
                      const DisplayObject& object) {
  const bool on_head = object.place == ObjectPlace::kHead;
  append_header(bytes,
                on_head ? SceneCommand::kSetLocalTransform : SceneCommand::kSetWorldTransform, 44);
  append(bytes, id);
  const Vec3& p = object.position_m;
  const Quaternion& q = object.rotation;
  append_floats(bytes, {p.x, p.y, -p.z});
  append_floats(bytes, {-q.x, -q.y, q.z, q.w});
  append_floats(bytes, {object.scale.x, object.scale.y, object.scale.z});
}

void append_look(std::vector<std::uint8_t>& bytes, std::uint32_t id, const DisplayObject& object) {
  if (object.shape != ObjectShape::kText) {
    append_header(bytes, SceneCommand::kSetColour, 20);
    append(bytes, id);
    return append_colour(bytes, object.colour);
  }
  const std::string text = scene_text(object.text);
  append_header(bytes, SceneCommand::kSetText, 24 + text.size());
  append(bytes, id);
  append_floats(bytes, {object.cap_height_m / kCapHeightAtSizeOneM});
  append_colour(bytes, object.colour);
  bytes.insert(bytes.end(), text.begin(), text.end());
}

void append_remove(std::vector<std::uint8_t>& bytes, std::uint32_t id) {
  append_header(bytes, SceneCommand::kRemove, 4);
  append(bytes, id);
}

void append_plain(std::vector<std::uint8_t>& bytes, SceneCommand command) {
  append_header(bytes, command, 0);
}

void append_idle(std::vector<std::uint8_t>& bytes) {
  append_header(bytes, SceneCommand::kSetTargetMode, 4);
  append(bytes, std::uint32_t{0});
}

std::string scene_text(const std::string& text) {
  std::string shown;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t next = i + 1;
    while (next < text.size() && (static_cast<unsigned char>(text[next]) & 0xC0u) == 0x80u) {
      ++next;
    }
    const std::string_view character = written(std::string_view(text).substr(i, next - i));
    if (shown.size() + character.size() > kMaxSceneTextBytes) {
      break;
    }
    shown += character;
    i = next;
  }
  return shown;
}

Result<std::optional<SceneMessage>> read_scene_message(Bytes bytes) {
  if (bytes.size() < kSceneHeaderBytes) {
    return std::optional<SceneMessage>();
  }
  const auto size = number_at<std::uint32_t>(bytes, 4);
  if (size > kMaxScenePayload) {
    return Error{"scene: a message of " + std::to_string(size) + " bytes, limit " +
                 std::to_string(kMaxScenePayload)};
  }
  if (bytes.size() - kSceneHeaderBytes < size) {
    return std::optional<SceneMessage>();
  }
  return std::optional<SceneMessage>(SceneMessage{number_at<std::uint32_t>(bytes, 0),
                                                  bytes.subspan(kSceneHeaderBytes, size),
                                                  kSceneHeaderBytes + size});
}

}  // namespace orthonav::hl2ss
