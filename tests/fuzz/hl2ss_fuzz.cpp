#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "hal/hl2ss/packet.h"
#include "hal/hl2ss/protocol.h"
#include "hal/hl2ss/standin_message.h"
#include "hal/hl2ss/video.h"
#include "hal/hl2ss/voice.h"
#include "tests/fuzz/input_file.h"

namespace orthonav::fuzz {
namespace {

using hl2ss::Bytes;

/// A stream that arrives torn: the input's first byte says in which pieces.
void follow_stream(Bytes input) {
  if (input.empty()) {
    return;
  }
  const std::size_t piece = 1 + input[0];
  Bytes rest = input.subspan(1);
  hl2ss::PacketAssembler assembler("fuzz", {4096, true});
  while (!rest.empty()) {
    const auto room = assembler.room();
    const std::size_t count = std::min({piece, rest.size(), room.size()});
    std::copy_n(rest.begin(), count, room.begin());
    assembler.received(count);
    rest = rest.subspan(count);
    for (;;) {
      const auto packet = assembler.next();
      if (!packet) {
        return;
      }
      if (!*packet) {
        break;
      }
      insist((*packet)->payload.size() <= 4096 && (*packet)->pose.size() == hl2ss::kPoseBytes);
      if (const auto image = hl2ss::split_image((*packet)->payload)) {
        insist(!image->image.empty());
      }
      const auto pose = hl2ss::read_pose((*packet)->pose);
      if (pose && *pose) {
        insist((*pose)->translation().is_finite());
      }
    }
  }
}

void read_alone(Bytes input) {
  const auto pose = hl2ss::read_pose(input);
  if (pose && *pose) {
    insist(orthonormality_error((*pose)->rotation()) <= 1e-9);
  }
  const auto request = hl2ss::read_video_request(input);
  if (request && *request) {
    insist((*request)->bytes <= input.size());
  }
  const auto words = hl2ss::read_vocabulary(input);
  if (words && *words) {
    insist((*words)->bytes <= input.size());
  }
  const auto voice = hl2ss::read_voice_answer(input);
  if (voice && *voice) {
    insist((*voice)->bytes <= input.size());
  }
  const auto standin = hl2ss::read_standin_message(input);
  if (standin && *standin) {
    insist((*standin)->bytes <= input.size());
  }
}

}  // namespace

/// The first byte chooses between a stream of packets and a message of its own.
void fuzz_hl2ss(Bytes input) {
  if (input.empty()) {
    return;
  }
  if (input[0] % 2 == 0) {
    follow_stream(input.subspan(1));
  } else {
    read_alone(input.subspan(1));
  }
}

}  // namespace orthonav::fuzz
