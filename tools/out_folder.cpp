#include "tools/out_folder.h"

#include <utility>

namespace orthonav::tools {

namespace fs = std::filesystem;

Result<OutFolder> OutFolder::create(const std::string& option, const std::string& path) {
  std::error_code code;
  std::vector<fs::path> made;
  fs::path missing = fs::path(path).lexically_normal();
  if (!missing.has_filename()) {
    missing = missing.parent_path();
  }
  for (; !missing.empty() && !fs::exists(missing, code); missing = missing.parent_path()) {
    made.push_back(missing);
  }
  fs::create_directories(path, code);
  OutFolder folder(path, std::move(made));
  if (!code && !fs::is_directory(path, code)) {
    code = std::make_error_code(std::errc::not_a_directory);
  }
  if (code) {
    return Error{option + " " + path + ": " + code.message()};
  }
  return folder;
}

OutFolder::OutFolder(OutFolder&& other) noexcept
    : path_(std::move(other.path_)), made_(std::exchange(other.made_, {})) {}

OutFolder::~OutFolder() {
  std::error_code not_empty;
  for (const fs::path& folder : made_) {
    fs::remove(folder, not_empty);
  }
}

}  // namespace orthonav::tools
