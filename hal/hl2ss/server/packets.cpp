#include "hal/hl2ss/server/packets.h"

#include <cmath>
#include <numbers>

namespace orthonav::hl2ss {

std::vector<std::uint8_t> packet_bytes(std::int64_t ticks, Bytes payload) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(kPacketHeaderBytes + payload.size() + kPoseBytes);
  append(bytes, static_cast<std::uint64_t>(ticks));
  append(bytes, static_cast<std::uint32_t>(payload.size()));
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  return bytes;
}

std::vector<std::uint8_t> image_packet(std::int64_t ticks, Bytes image,
                                       const ImageTrailer& trailer) {
  std::vector<std::uint8_t> payload;
  payload.reserve(image.size() + kImageTrailerBytes);
  payload.assign(image.begin(), image.end());
  append(payload, trailer.sensor_ticks);
  append(payload, trailer.exposure_ns);
  append(payload, trailer.gain);
  append(payload, std::uint32_t{0});
  return packet_bytes(ticks, payload);
}

std::vector<std::uint8_t> tone_bytes(std::int64_t first, int count) {
  constexpr double kTurnsASample = 440.0 / kMicrophoneHz;
  constexpr double kLoud = 8000.0;
  std::vector<std::uint8_t> bytes;
  for (std::int64_t i = first; i < first + count; ++i) {
    const double phase =
        2.0 * std::numbers::pi * std::fmod(kTurnsASample * static_cast<double>(i), 1.0);
    append(bytes, static_cast<std::int16_t>(kLoud * std::sin(phase)));
    append(bytes, static_cast<std::int16_t>(0.5 * kLoud * std::sin(phase)));
  }
  return bytes;
}

}  // namespace orthonav::hl2ss
