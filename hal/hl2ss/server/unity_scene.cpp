#include "hal/hl2ss/server/unity_scene.h"

#include <algorithm>
#include <optional>

namespace orthonav::hl2ss {
namespace {

constexpr std::uint32_t kDone = 1;
constexpr std::uint32_t kRefused = 0;

Vec3 take_vec3(ByteReader& reader) {
  const double x = reader.take<float>();
  const double y = reader.take<float>();
  const double z = reader.take<float>();
  return {x, y, z};
}

bool place(ByteReader& reader, bool on_head, UnityObject& object) {
  const Vec3 position = take_vec3(reader);
  const double qx = reader.take<float>();
  const double qy = reader.take<float>();
  const double qz = reader.take<float>();
  const double qw = reader.take<float>();
  const Vec3 scale = take_vec3(reader);
  if (!reader.ok()) {
    return false;
  }
  object.on_head = on_head;
  object.position_m = {position.x, position.y, -position.z};
  object.rotation = {-qx, -qy, qz, qw};
  object.scale = scale;
  return true;
}

std::optional<ObjectColour> take_colour(ByteReader& reader) {
  ObjectColour colour;
  colour.r = reader.take<float>();
  colour.g = reader.take<float>();
  colour.b = reader.take<float>();
  colour.a = reader.take<float>();
  return reader.ok() ? std::optional(colour) : std::nullopt;
}

bool paint(ByteReader& reader, UnityObject& object) {
  const auto colour = take_colour(reader);
  if (colour && !object.is_text) {
    object.colour = *colour;
  }
  return colour.has_value();
}

bool write(ByteReader& reader, UnityObject& object) {
  const double font_size = reader.take<float>();
  const auto colour = take_colour(reader);
  if (!colour || !object.is_text) {
    return false;
  }
  const Bytes text = reader.take_bytes(reader.left());
  object.font_size = font_size;
  object.colour = *colour;
  object.text.assign(text.begin(), text.end());
  return true;
}

}  // namespace

void UnityScene::add(const SceneMessage& message) {
  queue_.push_back({message.command, {message.payload.begin(), message.payload.end()}, false});
}

void UnityScene::client_left() { queue_.push_back({0, {}, true}); }

void UnityScene::run_frame(std::vector<std::uint32_t>& answers) {
  do {
    if (queue_.empty()) {
      return;
    }
    const Waiting message = std::move(queue_.front());
    queue_.pop_front();
    if (message.leaves) {
      in_list_ = targets_last_ = false;
      answers.clear();  // the client is gone
      return;
    }
    answers.push_back(execute(message));
  } while (in_list_);
}

std::uint32_t UnityScene::execute(const Waiting& message) {
  const auto command = static_cast<SceneCommand>(message.command);
  ByteReader reader(message.payload);
  switch (command) {
    case SceneCommand::kCreatePrimitive: {
      constexpr auto kLast = static_cast<std::uint32_t>(Primitive::kQuad);
      const auto primitive = static_cast<Primitive>(std::min(reader.take<std::uint32_t>(), kLast));
      return reader.ok() ? create(false, primitive) : kRefused;
    }
    case SceneCommand::kCreateText:
      return create(true, {});
    case SceneCommand::kSay:
      return kDone;
    case SceneCommand::kRemoveAll:
      objects_.clear();
      return kDone;
    case SceneCommand::kBeginList:
    case SceneCommand::kEndList:
      in_list_ = command == SceneCommand::kBeginList;
      return kDone;
    case SceneCommand::kSetTargetMode: {
      const bool last = reader.take<std::uint32_t>() != 0;
      targets_last_ = reader.ok() ? last : targets_last_;
      return reader.ok() ? kDone : kRefused;
    }
    default:
      return change(command, message.payload);
  }
}

std::uint32_t UnityScene::create(bool is_text, Primitive primitive) {
  if (to_refuse_ > 0) {
    --to_refuse_;
    return kRefused;
  }
  last_created_ = next_id_ -= 2;
  UnityObject& object = objects_[last_created_];
  object.is_text = is_text;
  object.primitive = primitive;
  return last_created_;
}

UnityObject* UnityScene::target(std::uint32_t id) {
  const auto found = objects_.find(targets_last_ ? last_created_ : id);
  return found == objects_.end() ? nullptr : &found->second;
}

std::uint32_t UnityScene::change(SceneCommand command, Bytes payload) {
  ByteReader reader(payload);
  const auto id = reader.take<std::uint32_t>();
  UnityObject* object = reader.ok() ? target(id) : nullptr;
  if (!object) {
    return kRefused;
  }
  if (to_refuse_ > 0) {
    --to_refuse_;
    return kRefused;
  }
  switch (command) {
    case SceneCommand::kSetActive: {
      const bool active = reader.take<std::uint32_t>() != 0;
      object->active = reader.ok() ? active : object->active;
      return reader.ok() ? kDone : kRefused;
    }
    case SceneCommand::kSetWorldTransform:
    case SceneCommand::kSetLocalTransform:
      return place(reader, command == SceneCommand::kSetLocalTransform, *object) ? kDone : kRefused;
    case SceneCommand::kSetColour:
      return paint(reader, *object) ? kDone : kRefused;
    case SceneCommand::kSetTexture:
      return kDone;
    case SceneCommand::kSetText:
      return write(reader, *object) ? kDone : kRefused;
    case SceneCommand::kRemove:
      objects_.erase(targets_last_ ? last_created_ : id);
      return kDone;
    default:
      return kRefused;
  }
}

}  // namespace orthonav::hl2ss
