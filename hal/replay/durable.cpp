#include "hal/replay/durable.h"

#include <string>
#include <system_error>

#include "base/file_code.h"
#include "base/sync_path.h"
#include "hal/replay/text.h"

namespace orthonav::replay {

namespace {

/// Syncs a file's content, or the names in a folder.
Status sync(const std::filesystem::path& path) {
  const int error_number = sync_path(path.string()).error_number;
  return error_number == 0 ? Status{}
                           : file_error(path,
                                        "may not outlast a loss of power: " +
                                            std::generic_category().message(error_number),
                                        file_code(error_number));
}

}  // namespace

Status sync_all(const std::filesystem::path& folder) {
  std::error_code code;
  for (std::filesystem::recursive_directory_iterator at(folder, code), end; !code && at != end;
       at.increment(code)) {
    if (const Status synced = sync(at->path()); !synced) {
      return synced;
    }
  }
  return code ? file_error(folder, "cannot be read: " + code.message(), file_code(code))
              : sync(folder);
}

Status rename_durably(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (Status synced = sync_all(from); !synced) {
    return synced;
  }
  std::error_code code;
  std::filesystem::rename(from, to, code);
  if (code) {
    return file_error(from, "cannot be renamed: " + code.message(), file_code(code));
  }
  return sync(std::filesystem::absolute(to).parent_path());
}

}  // namespace orthonav::replay
