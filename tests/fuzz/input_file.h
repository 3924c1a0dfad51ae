#pragma once

#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>

#include "base/memory_file.h"
#include "base/result.h"

namespace orthonav::fuzz {

/// The text of a file that a reader finds by its name.
inline std::string text_of(std::span<const std::uint8_t> input) {
  return {input.begin(), input.end()};
}

/// A file in memory that holds an input: for readers that take paths.
class InputFile {
 public:
  explicit InputFile(std::span<const std::uint8_t> input)
      : file_(MemoryFile::create(text_of(input)).value()) {}
  [[nodiscard]] std::string path() const { return file_.path(); }

 private:
  MemoryFile file_;
};

/// A property that must hold for everything that a reader accepted.
inline void insist(bool holds) {
  if (!holds) {
    std::abort();
  }
}

/// A refusal is one line, whatever the input holds.
inline void insist_one_line(const Error& error) {
  insist(error.message.find('\n') == std::string::npos);
}

}  // namespace orthonav::fuzz
