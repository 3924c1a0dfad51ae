#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hal/hl2ss/bytes.h"
#include "hal/hl2ss/video.h"

namespace orthonav::hl2ss {

/// Packets as the headset sends them.
[[nodiscard]] std::vector<std::uint8_t> packet_bytes(std::int64_t ticks, Bytes payload);
/// `image`: a raw picture or an access unit.
[[nodiscard]] std::vector<std::uint8_t> image_packet(std::int64_t ticks, Bytes image,
                                                     const ImageTrailer& trailer);
/// Two channels of a 440 Hz tone, the right one half as loud, from sample `first` on.
[[nodiscard]] std::vector<std::uint8_t> tone_bytes(std::int64_t first, int count);

}  // namespace orthonav::hl2ss
