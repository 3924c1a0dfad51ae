#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace orthonav::voice::voice_test {

/// A WAV file of 16 bits, written by hand.
inline std::string wav_of(const std::vector<std::int16_t>& samples, int rate_hz, int channels) {
  std::string bytes = "RIFF----WAVEfmt ";
  const auto put = [&](auto value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  const auto size = static_cast<std::uint32_t>(samples.size() * 2);
  put(std::uint32_t{16});
  put(std::uint16_t{1});
  put(static_cast<std::uint16_t>(channels));
  put(static_cast<std::uint32_t>(rate_hz));
  put(static_cast<std::uint32_t>(rate_hz * channels * 2));
  put(static_cast<std::uint16_t>(channels * 2));
  put(std::uint16_t{16});
  bytes += "data";
  put(size);
  bytes.append(reinterpret_cast<const char*>(samples.data()), size);
  const auto riff = static_cast<std::uint32_t>(bytes.size() - 8);
  std::memcpy(bytes.data() + 4, &riff, 4);
  return bytes;
}

}  // namespace orthonav::voice::voice_test
