#include "hal/replay/durable.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "hal/replay/text.h"

namespace orthonav::replay {

Status sync(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool synced = file >= 0 && ::fsync(file) == 0;
  const std::error_code code(errno, std::generic_category());
  if (file >= 0) {
    ::close(file);
  }
  return synced ? Status{} : file_error(path, "may not outlast a loss of power: " + code.message());
}

Status sync_all(const std::filesystem::path& folder) {
  std::error_code code;
  for (std::filesystem::recursive_directory_iterator at(folder, code), end; !code && at != end;
       at.increment(code)) {
    if (const Status synced = sync(at->path()); !synced) {
      return synced;
    }
  }
  return code ? file_error(folder, "cannot be read: " + code.message()) : sync(folder);
}

Status rename_durably(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (Status synced = sync_all(from); !synced) {
    return synced;
  }
  std::error_code code;
  std::filesystem::rename(from, to, code);
  if (code) {
    return file_error(from, "cannot be renamed: " + code.message());
  }
  return sync(std::filesystem::absolute(to).parent_path());
}

}  // namespace orthonav::replay
