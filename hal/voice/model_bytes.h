#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "base/result.h"

namespace orthonav::voice {

/// Numbers in the files of an acoustic model, little-endian like this machine.
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

/// Empty where there is no such file.
[[nodiscard]] std::string model_file(const std::filesystem::path& path);

/// The beginning of a file of sphinxtrain's: a header in lines, and a number for the byte order.
[[nodiscard]] std::string sphinx_file_start();
/// What follows that beginning; nothing where a file begins differently.
[[nodiscard]] std::optional<std::string_view> after_sphinx_file_start(std::string_view file);

/// FNV-1a, to tell one model from another.
[[nodiscard]] std::uint64_t hash_of(std::string_view bytes);
[[nodiscard]] Error made_for_another_model();

}  // namespace orthonav::voice
