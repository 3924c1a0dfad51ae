#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace orthonav::desktop {

/// Numbers in the files of an acoustic model, little endian as this machine.
template <class T>
void put(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

/// Takes a value off the front; zero where there is none left.
template <class T>
T take(std::string_view& bytes) {
  T value{};
  if (bytes.size() < sizeof(value)) return T{};
  std::memcpy(&value, bytes.data(), sizeof(value));
  bytes.remove_prefix(sizeof(value));
  return value;
}

/// FNV-1a, to tell one model from another.
inline std::uint64_t hash_of(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
  return hash;
}

}  // namespace orthonav::desktop
