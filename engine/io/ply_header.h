#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"

/// The layout of the data after a PLY file's header.
namespace orthonav::engine::ply {

enum class Encoding : std::uint8_t { kAscii, kLittle, kBig };
enum class Kind : std::uint8_t { kSigned, kUnsigned, kReal };

struct Type {
  std::size_t bytes = 0;
  Kind kind = Kind::kSigned;
};

struct Property {
  std::string name;
  Type type;
  std::optional<Type> count;  ///< for a list: the type of its count
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  Encoding encoding = Encoding::kAscii;
  std::vector<Element> elements;
  std::size_t end = 0;  ///< where the data begin
};

/// Refuses anything but a complete header of version 1.0.
Result<Header> read_header(const std::string& text);

}  // namespace orthonav::engine::ply
