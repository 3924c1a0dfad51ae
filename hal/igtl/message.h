#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "hal/igtl/header.h"

// Messages of OpenIGTLink (protocol version 1) as bytes. Lengths are in millimetres, as on the
// wire.
namespace orthonav::igtl {

/// The device and time that every header states.
struct Label {
  std::string device;           ///< at most 20 bytes; the rest is cut
  std::uint64_t timestamp = 0;  ///< seconds, 32 bits before the point and 32 after it
};

/// Columns of the rotation, then the translation in mm: B_from_A of a device `AToB`.
using TransformValues = std::array<float, 12>;

/// STATUS codes of the protocol.
inline constexpr std::uint16_t kStatusOk = 1;
inline constexpr std::uint16_t kStatusTimeout = 7;

struct StatusValues {
  std::uint16_t code = kStatusOk;
  std::int64_t subcode = 0;
  std::string name;  ///< at most 20 bytes
  std::string message;
};

struct PointValues {
  std::string name;   ///< at most 64 bytes
  std::string group;  ///< at most 32 bytes
  std::array<std::uint8_t, 4> rgba{};
  std::array<float, 3> position_mm{};
  /// The field that the protocol calls diameter and Debian's library radius.
  float radius_mm = 0.0F;
  std::string owner;  ///< at most 20 bytes
};

using Triangle = std::array<std::uint32_t, 3>;

[[nodiscard]] std::vector<std::uint8_t> packed(const Label& label, const TransformValues& values);
[[nodiscard]] std::vector<std::uint8_t> packed(const Label& label, const StatusValues& values);
[[nodiscard]] std::vector<std::uint8_t> packed(const Label& label,
                                               std::span<const PointValues> values);
/// A surface.
[[nodiscard]] std::vector<std::uint8_t> packed(const Label& label,
                                               std::span<const std::array<float, 3>> points_mm,
                                               std::span<const Triangle> triangles);
/// Text in ASCII or UTF-8; cut at 65,535 bytes, since the length has 16 bits.
[[nodiscard]] std::vector<std::uint8_t> packed_text(const Label& label, const std::string& text);

}  // namespace orthonav::igtl
