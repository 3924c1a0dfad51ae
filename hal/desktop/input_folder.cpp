#include "hal/desktop/input_folder.h"

#include <sys/inotify.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "base/file_code.h"

namespace orthonav::desktop {

Result<InputFolder> InputFolder::watch(const std::string& folder) {
  const int watch = ::inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
  if (watch < 0) {
    return Error{std::string("clicker: inotify: ") + std::generic_category().message(errno),
                 ErrorCode::kUnavailable};
  }
  InputFolder made(folder, watch);
  if (::inotify_add_watch(watch, folder.c_str(), IN_CREATE | IN_ATTRIB | IN_DELETE | IN_MOVED_TO) <
      0) {
    return Error{"clicker: " + folder +
                     " cannot be watched for devices: " + std::generic_category().message(errno),
                 file_code(errno)};
  }
  return made;
}

InputFolder::~InputFolder() {
  if (watch_ >= 0) {
    ::close(watch_);
  }
}

bool InputFolder::changed() {
  // Which device it was does not matter: the whole folder is read again.
  alignas(inotify_event) std::array<char, 4096> bytes;
  bool any = false;
  constexpr int kMaxReads = 16;
  for (int i = 0; i<kMaxReads&& ::read(watch_, bytes.data(), bytes.size())> 0; ++i) {
    any = true;
  }
  return any;
}

std::vector<std::string> InputFolder::devices() const {
  std::vector<std::string> paths;
  std::error_code code;
  for (std::filesystem::directory_iterator at(folder_, code), end; !code && at != end;
       at.increment(code)) {
    if (at->path().filename().string().starts_with("event")) {
      paths.push_back(at->path().string());
    }
  }
  std::sort(paths.begin(), paths.end(), [](const std::string& a, const std::string& b) {
    return a.size() != b.size() ? a.size() < b.size() : a < b;
  });
  return paths;
}

}  // namespace orthonav::desktop
