#pragma once

#include <string>

#include "base/time.h"
#include "hal/hl2ss/bytes.h"

namespace orthonav::hl2ss {

// Times and texts of the stand-in's messages.

inline void append_time(std::vector<std::uint8_t>& bytes, Timestamp time) {
  append(bytes, std::int64_t{time.time_since_epoch().count()});
}
inline Timestamp take_time(ByteReader& reader) {
  return Timestamp(Duration(reader.take<std::int64_t>()));
}

inline void append_text(std::vector<std::uint8_t>& bytes, const std::string& text) {
  append(bytes, static_cast<std::uint32_t>(text.size()));
  bytes.insert(bytes.end(), text.begin(), text.end());
}
inline std::string take_text(ByteReader& reader) {
  const Bytes letters = reader.take_bytes(reader.take<std::uint32_t>());
  return {letters.begin(), letters.end()};
}

}  // namespace orthonav::hl2ss
