#include "engine/io/folders.h"

#include <fcntl.h>

#include <system_error>

#include "base/file_code.h"
#include "base/sync_path.h"
#include "engine/io/file_names.h"

namespace orthonav::engine {
namespace fs = std::filesystem;
namespace {

std::vector<fs::path> missing_at(const std::string& path) {
  std::error_code ignored;
  std::vector<fs::path> missing;
  fs::path folder = fs::path(path).lexically_normal();
  if (!folder.has_filename()) {
    folder = folder.parent_path();
  }
  for (; !folder.empty() && !fs::exists(folder, ignored); folder = folder.parent_path()) {
    missing.push_back(folder);
  }
  return missing;
}

Status made(const std::string& path) {
  std::error_code code;
  fs::create_directories(path, code);
  if (!code && !fs::is_directory(path, code)) {
    code = std::make_error_code(std::errc::not_a_directory);
  }
  return code ? Status(Error{path + ": " + code.message(), file_code(code)}) : Status{};
}

}  // namespace

Status sync_folder(const std::string& folder) {
  const PathSync synced = sync_path(folder, O_DIRECTORY);
  return synced.error_number == 0 ? Status{}
                                  : file_error(folder, "cannot be written", synced.error_number);
}

Result<std::vector<fs::path>> make_folders(const std::string& path) {
  std::vector<fs::path> folders = missing_at(path);
  Status durable = made(path);
  for (auto folder = folders.rbegin(); durable && folder != folders.rend(); ++folder) {
    durable = sync_folder(folder_of(folder->string()));
  }
  if (!durable) {
    remove_empty(folders);
    return durable.error();
  }
  return folders;
}

void remove_empty(const std::vector<fs::path>& folders) {
  std::error_code not_empty;
  for (const fs::path& folder : folders) {
    fs::remove(folder, not_empty);
  }
}

}  // namespace orthonav::engine
