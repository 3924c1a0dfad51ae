#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>

namespace orthonav::fuzz {

/// A file in memory that holds an input: for readers that take paths.
class InputFile {
 public:
  explicit InputFile(std::span<const std::uint8_t> input) : file_(::memfd_create("input", 0)) {
    while (!input.empty()) {
      const ssize_t count = ::write(file_, input.data(), input.size());
      if (count <= 0) {
        std::abort();
      }
      input = input.subspan(static_cast<std::size_t>(count));
    }
  }
  ~InputFile() { ::close(file_); }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
};

/// The text of a file that a reader finds by its name.
inline std::string text_of(std::span<const std::uint8_t> input) {
  return {input.begin(), input.end()};
}

/// A property that must hold for everything that a reader accepted.
inline void insist(bool holds) {
  if (!holds) {
    std::abort();
  }
}

}  // namespace orthonav::fuzz
