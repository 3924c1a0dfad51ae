#include "tools/orthonav/shared/out_folder.h"

#include <utility>

#include "engine/io/folders.h"

namespace orthonav::tools {

Result<OutFolder> OutFolder::create(const std::string& option, const std::string& path) {
  auto made = engine::make_folders(path);
  if (!made) {
    return Error{option + " " + made.error().message, made.error().code};
  }
  return OutFolder(path, std::move(*made));
}

OutFolder::OutFolder(OutFolder&& other) noexcept
    : path_(std::move(other.path_)), made_(std::exchange(other.made_, {})) {}

Status OutFolder::check_absent(const std::vector<std::string>& names) const {
  std::error_code code;
  for (const std::string& name : names) {
    if (std::filesystem::exists(path_ / name, code)) {
      return Error{file(name) + ": already exists"};
    }
  }
  return {};
}

OutFolder::~OutFolder() { engine::remove_empty(made_); }

}  // namespace orthonav::tools
