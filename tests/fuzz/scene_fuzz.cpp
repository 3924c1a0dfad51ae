#include <algorithm>
#include <cstdlib>

#include "hal/hl2ss/scene_client.h"
#include "hal/hl2ss/server/unity_scene.h"
#include "tests/fuzz/input_file.h"

namespace orthonav::fuzz {
namespace {

using hl2ss::Bytes;

/// Anything may come to the application.
void tell_application(Bytes input) {
  hl2ss::UnityScene scene;
  for (;;) {
    const auto message = hl2ss::read_scene_message(input);
    if (!message || !*message) {
      break;
    }
    insist((*message)->bytes <= input.size());
    scene.add(**message);
    input = input.subspan((*message)->bytes);
  }
  std::vector<std::uint32_t> answers;
  while (!scene.is_idle()) {
    scene.run_frame(answers);
  }
  insist(scene.objects().size() <= answers.size());
}

DisplayObject object_of(std::uint8_t byte) {
  DisplayObject object;
  object.key = byte % 16;
  object.shape = static_cast<ObjectShape>(byte % 5);
  object.follows_tool = byte % 3 == 0;
  object.position_m.x = byte;
  object.text = std::string(byte, static_cast<char>(byte));
  return object;
}

/// Answers may be anything; the client must still send whole messages.
void answer_client(Bytes input) {
  hl2ss::SceneClient client;
  hl2ss::SceneMoment now{HostTime(std::chrono::seconds(9)), Timestamp(std::chrono::seconds(5))};
  client.connected(now.host);
  for (const std::uint8_t byte : input) {
    now.host += std::chrono::milliseconds(4);
    now.headset += std::chrono::milliseconds(4);
    if (byte >= 192) {
      ObjectList list;
      list.map_epoch = byte == 255 ? 1 : 0;
      list.tool_time = now.headset - std::chrono::milliseconds(byte - 192);
      for (int i = 0; i < byte % 8; ++i) {
        list.objects.push_back(object_of(static_cast<std::uint8_t>(byte * (i + 3))));
        list.objects.back().key = static_cast<std::uint64_t>(i);
      }
      client.want(list);
    }
    const auto said = client.next(now);
    Bytes rest = said;
    while (!rest.empty()) {
      const auto message = hl2ss::read_scene_message(rest);
      insist(message && *message);
      rest = rest.subspan((*message)->bytes);
    }
    if (byte < 192 && !client.answered(byte < 128 ? 1 : byte < 160 ? 0 : 1000u + byte, now)) {
      client.connected(now.host);
    }
  }
}

}  // namespace

/// The first byte chooses the direction.
void fuzz_scene(Bytes input) {
  if (input.empty()) {
    return;
  }
  if (input[0] % 2 == 0) {
    tell_application(input.subspan(1));
  } else {
    answer_client(input.subspan(1));
  }
}

}  // namespace orthonav::fuzz
