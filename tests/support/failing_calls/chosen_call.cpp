#include "tests/support/failing_calls/chosen_call.h"

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>

namespace orthonav::test::failing_calls {
namespace {

constexpr std::array<std::string_view, 7> kNames = {"open",  "write",    "sync", "rename",
                                                    "mkdir", "truncate", "close"};

std::string_view asked(const char* name) {
  const char* const value = std::getenv(name);
  return value != nullptr ? value : "";
}

long number(const char* name) {
  const char* const value = std::getenv(name);
  return value != nullptr ? std::strtol(value, nullptr, 10) : 0;
}

/// Resolves the links that /proc keeps for open files; empty if unknown.
std::string_view followed(const char* path, std::array<char, PATH_MAX>& held) {
  if (std::strncmp(path, "/proc/self/fd/", 14) != 0) {
    return path;
  }
  const ssize_t bytes = ::readlink(path, held.data(), held.size());
  return {held.data(), bytes > 0 ? static_cast<std::size_t>(bytes) : 0};
}

/// By the system call itself, which is not intercepted.
void list(std::string_view kind, std::string_view path) {
  const std::string_view file = asked("FAILING_CALLS_LIST");
  if (file.empty()) {
    return;
  }
  std::array<char, PATH_MAX + 16> line{};
  const int bytes =
      std::snprintf(line.data(), line.size(), "%.*s %.*s\n", static_cast<int>(kind.size()),
                    kind.data(), static_cast<int>(path.size()), path.data());
  const long opened =
      ::syscall(SYS_openat, AT_FDCWD, file.data(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  if (opened >= 0) {
    ::syscall(SYS_write, opened, line.data(), bytes);
    ::syscall(SYS_close, opened);
  }
}

bool is_below(std::string_view path, std::string_view folder) {
  return !folder.empty() && path.starts_with(folder) &&
         (path.size() == folder.size() || path[folder.size()] == '/');
}

/// Number of matching calls, over all threads.
std::atomic<long>& count() {
  static std::atomic<long> calls = 0;
  return calls;
}

bool is_chosen(Kind kind, std::string_view path) {
  const std::string_view name = kNames.at(static_cast<std::size_t>(kind));
  const std::string_view kind_asked = asked("FAILING_CALLS_KIND");
  const bool counts = (kind_asked.empty() || kind_asked == name) &&
                      path.find(asked("FAILING_CALLS_NAME")) != std::string_view::npos;
  const long at = number("FAILING_CALLS_AT");
  const long reached = counts ? ++count() : count().load();
  const bool lasting = number("FAILING_CALLS_LASTING") != 0 && kind != Kind::kClose;
  return at > 0 && ((counts && reached == at) || (lasting && reached >= at));
}

}  // namespace

bool fails(Kind kind, const char* path) {
  const int before = errno;
  std::array<char, PATH_MAX> held{};
  const std::string_view whole = path != nullptr ? followed(path, held) : "";
  if (!is_below(whole, asked("FAILING_CALLS_FOLDER"))) {
    errno = before;
    return false;
  }
  list(kNames.at(static_cast<std::size_t>(kind)), whole);
  const bool chosen = is_chosen(kind, whole);
  errno = chosen ? static_cast<int>(number("FAILING_CALLS_WITH")) : before;
  return chosen;
}

bool fails(Kind kind, int file) {
  std::array<char, 40> link{};
  std::snprintf(link.data(), link.size(), "/proc/self/fd/%d", file);
  return fails(kind, link.data());
}

bool is_for_writing(int file) {
  const int before = errno;
  const int flags = ::fcntl(file, F_GETFL);
  errno = before;
  return flags >= 0 && (flags & O_ACCMODE) != O_RDONLY;
}

}  // namespace orthonav::test::failing_calls
