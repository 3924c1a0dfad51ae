#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <utility>

namespace orthonav::test {

/// A pipe that takes nothing more until somebody reads it, as a terminal after Ctrl-S.
class FullPipe {
 public:
  FullPipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0) {
      std::abort();
    }
    ::fcntl(ends_[1], F_SETFL, O_NONBLOCK);
    const std::array<char, 4096> filling{};
    while (::write(ends_[1], filling.data(), filling.size()) > 0) {
    }
    ::fcntl(ends_[1], F_SETFL, 0);
  }
  ~FullPipe() {
    close_reader();
    ::close(ends_[1]);
  }
  FullPipe(const FullPipe&) = delete;
  FullPipe& operator=(const FullPipe&) = delete;
  [[nodiscard]] int writer() const { return ends_[1]; }
  void close_reader() {
    if (ends_[0] >= 0) {
      ::close(std::exchange(ends_[0], -1));
    }
  }
  /// Reads until the text ends with `last`; without what filled the pipe.
  std::string read_until(const std::string& last) {
    std::string text;
    std::array<char, 4096> part{};
    while (!text.ends_with(last)) {
      const ssize_t n = ::read(ends_[0], part.data(), part.size());
      if (n <= 0) {
        break;
      }
      text.append(part.data(), static_cast<std::size_t>(n));
    }
    std::erase(text, '\0');
    return text;
  }

 private:
  std::array<int, 2> ends_{-1, -1};
};

}  // namespace orthonav::test
