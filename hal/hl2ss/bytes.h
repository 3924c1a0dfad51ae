#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace orthonav::hl2ss {

// The protocol is little-endian, and so is every machine that this is built for.
static_assert(std::endian::native == std::endian::little);

using Bytes = std::span<const std::uint8_t>;

template <class T>
concept Number = std::is_arithmetic_v<T>;

/// The number that begins at `at`; the caller must have checked that it lies inside.
template <Number T>
[[nodiscard]] T number_at(Bytes bytes, std::size_t at) {
  T value{};
  std::memcpy(&value, bytes.data() + at, sizeof(T));
  return value;
}

template <Number T>
void append(std::vector<std::uint8_t>& bytes, T value) {
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof(T));
  std::memcpy(bytes.data() + at, &value, sizeof(T));
}

/// Takes numbers off the front. After the bytes run out, every further answer is 0 and `ok` stays
/// false, so a reader needs to check only once, at the end.
class ByteReader {
 public:
  explicit ByteReader(Bytes bytes) : rest_(bytes) {}

  template <Number T>
  T take() {
    if (rest_.size() < sizeof(T)) {
      fail();
      return T{};
    }
    const T value = number_at<T>(rest_, 0);
    rest_ = rest_.subspan(sizeof(T));
    return value;
  }
  Bytes take_bytes(std::size_t count) {
    if (rest_.size() < count) {
      fail();
      return {};
    }
    const Bytes taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }
  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] std::size_t left() const { return rest_.size(); }

 private:
  void fail() {
    ok_ = false;
    rest_ = {};
  }

  Bytes rest_;
  bool ok_ = true;
};

}  // namespace orthonav::hl2ss
