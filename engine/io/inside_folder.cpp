#include "engine/io/inside_folder.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "base/file_code.h"

namespace orthonav::engine {
namespace {

namespace fs = std::filesystem;

bool steps_out(const fs::path& name) {
  return name.is_absolute() || std::find(name.begin(), name.end(), "..") != name.end();
}

/// Both paths must be canonical.
bool lies_in(const fs::path& folder, const fs::path& path) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first ==
         folder.end();
}

}  // namespace

Result<std::string> path_inside(const std::string& folder, const std::string& name) {
  const fs::path path = fs::path(folder) / name;
  if (name.empty() || name.find('\0') != std::string::npos) {
    return Error{folder + ": a file of it has no name"};
  }
  if (steps_out(name)) {
    return Error{path.string() + ": \"" + name + "\" leads out of " + folder +
                 ", must name a file in it"};
  }
  std::error_code problem;
  const fs::path home = fs::canonical(folder.empty() ? "." : folder, problem);
  if (problem) {
    return path.string();  // does not exist: opening the file will say so
  }
  const fs::path real = fs::weakly_canonical(path, problem);
  if (problem) {
    return Error{path.string() + ": cannot be followed: " + problem.message(), file_code(problem)};
  }
  if (!lies_in(home, real)) {
    return Error{path.string() + ": is a link that leads out of " + folder};
  }
  const fs::file_status found = fs::status(real, problem);
  if (fs::exists(found) && !fs::is_regular_file(found)) {
    return Error{path.string() + ": is not a plain file"};
  }
  return path.string();
}

bool is_part_of_a_file_name(const std::string& text) {
  constexpr std::size_t kLongest = 64;
  const bool plain = std::none_of(
      text.begin(), text.end(), [](unsigned char c) { return c == '/' || c < 0x20 || c == 0x7f; });
  return plain && !text.empty() && text.size() <= kLongest && text.front() != '.';
}

}  // namespace orthonav::engine
