#include "tests/support/file_calls.h"

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <condition_variable>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <optional>
#include <utility>

namespace {

namespace fs = std::filesystem;

std::atomic<bool> g_watching{false};
std::mutex g_mutex;
std::string g_folder;     ///< as given
std::string g_canonical;  ///< as resolved from descriptors
std::vector<std::string> g_made;
std::optional<std::pair<std::string, int>> g_fails;
std::condition_variable g_changed;
std::string g_held;

/// The path as reported; nothing if the file lies elsewhere.
std::optional<std::string> told(const std::string& path) {
  for (const std::string& folder : {g_folder, g_canonical}) {
    if (path == folder) {
      return ".";
    }
    if (path.rfind(folder + "/", 0) == 0) {
      const std::string name = path.substr(folder.size() + 1);
      return name.front() == '#' ? "(nameless)" : name;
    }
  }
  return std::nullopt;
}

std::optional<std::string> told_of(int file) {
  std::error_code problem;
  const fs::path path = fs::read_symlink("/proc/self/fd/" + std::to_string(file), problem);
  return problem ? std::nullopt : told(path.string());
}

/// The error number if the call is to fail, otherwise 0.
int remember(const std::string& call) {
  g_made.push_back(call);
  if (!g_fails || g_fails->first != call) {
    return 0;
  }
  return std::exchange(g_fails, std::nullopt)->second;
}

/// Whether a call on that file may be made; sets errno if not.
bool may(const char* call, const std::optional<std::string>& file) {
  const int problem = file ? remember(std::string(call) + " " + *file) : 0;
  errno = problem != 0 ? problem : errno;
  return problem == 0;
}

bool may_with(const char* call, int file) {
  if (!g_watching) {
    return true;
  }
  std::unique_lock lock(g_mutex);
  const auto told = told_of(file);
  g_changed.wait(lock, [&] { return !told || g_held != std::string(call) + " " + *told; });
  return may(call, told);
}

bool may_name(const char* call, const std::string& from, const std::string& to) {
  if (!g_watching) {
    return true;
  }
  const std::scoped_lock lock(g_mutex);
  const auto new_name = told(to);
  if (!new_name) {
    return true;
  }
  return may(call, told(from).value_or("(nameless)") + " " + *new_name);
}

bool may_at(const char* call, const std::string& path) {
  if (!g_watching) {
    return true;
  }
  const std::scoped_lock lock(g_mutex);
  return may(call, told(path));
}

}  // namespace

// Replace the C library's functions. They call the kernel directly, so that no other such layer,
// for example a sanitizer's, has to be found first.
extern "C" {

ssize_t write(int file, const void* bytes, size_t count) {
  return may_with("write", file) ? ::syscall(SYS_write, file, bytes, count) : -1;
}

int fsync(int file) {
  return may_with("fsync", file) ? static_cast<int>(::syscall(SYS_fsync, file)) : -1;
}

int fdatasync(int file) {
  return may_with("fdatasync", file) ? static_cast<int>(::syscall(SYS_fdatasync, file)) : -1;
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to,
              unsigned flags) noexcept {
  return may_name("rename", from, to)
             ? static_cast<int>(::syscall(SYS_renameat2, from_folder, from, to_folder, to, flags))
             : -1;
}

int rename(const char* from, const char* to) noexcept {
  return ::renameat2(AT_FDCWD, from, AT_FDCWD, to, 0);
}

int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) noexcept {
  return may_name("link", from, to)
             ? static_cast<int>(::syscall(SYS_linkat, from_folder, from, to_folder, to, flags))
             : -1;
}

int truncate(const char* path, off_t size) noexcept {
  return may_at("truncate", path) ? static_cast<int>(::syscall(SYS_truncate, path, size)) : -1;
}

int unlink(const char* path) noexcept {
  return may_at("unlink", path) ? static_cast<int>(::syscall(SYS_unlinkat, AT_FDCWD, path, 0)) : -1;
}
}

namespace orthonav::test {

FileCalls::FileCalls(const std::string& folder) {
  const std::scoped_lock lock(g_mutex);
  g_folder = folder;
  g_canonical = fs::canonical(folder).string();
  g_made.clear();
  g_fails.reset();
  g_watching = true;
}

FileCalls::~FileCalls() {
  g_watching = false;
  hold({});
}

std::vector<std::string> FileCalls::made() {
  const std::scoped_lock lock(g_mutex);
  return g_made;
}

void FileCalls::hold(const std::string& call) {
  const std::scoped_lock lock(g_mutex);
  g_held = call;
  g_changed.notify_all();
}

void FileCalls::fail_next(const std::string& call, int error_number) {
  const std::scoped_lock lock(g_mutex);
  g_fails = {call, error_number};
}

}  // namespace orthonav::test
