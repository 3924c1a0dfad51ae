#include "engine/io/file_names.h"

#include <filesystem>
#include <system_error>

#include "base/file_code.h"

namespace orthonav::engine {
namespace fs = std::filesystem;

std::string folder_of(const std::string& path) {
  const fs::path parent = fs::path(path).parent_path();
  return parent.empty() ? "." : parent.string();
}

std::string earlier_name(const std::string& path, int number) {
  fs::path name = path;
  name.replace_filename(name.stem().string() + "-" + std::to_string(number) +
                        name.extension().string());
  return name.string();
}

Error too_many_earlier(const std::string& path) {
  return Error{path + ": " + std::to_string(kMaxEarlier) +
               " earlier ones lie beside it, move them away"};
}

Error file_error(const std::string& path, const std::string& doing, int error_number) {
  return {path + ": " + doing + ": " + std::generic_category().message(error_number),
          file_code(error_number)};
}

}  // namespace orthonav::engine
