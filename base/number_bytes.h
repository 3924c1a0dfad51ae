#pragma once

#include <bit>
#include <cstring>
#include <string>
#include <string_view>

namespace orthonav {

// Numbers in files are little-endian, and so is every machine that this is built for.
static_assert(std::endian::native == std::endian::little);

template <class T>
void put(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

/// Takes a value off the front; zero when nothing is left.
template <class T>
T take(std::string_view& bytes) {
  T value{};
  if (bytes.size() < sizeof(value)) {
    return T{};
  }
  std::memcpy(&value, bytes.data(), sizeof(value));
  bytes.remove_prefix(sizeof(value));
  return value;
}

}  // namespace orthonav
