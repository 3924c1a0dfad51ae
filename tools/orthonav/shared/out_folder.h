#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"

namespace orthonav::tools {

/// A folder for results. Folders that it made and that are still empty at the end are removed, so
/// that a refused command leaves nothing.
class OutFolder {
 public:
  /// Makes the folder and its parents, durably. `option`, such as "--out", stands for it in an
  /// error message.
  static Result<OutFolder> create(const std::string& option, const std::string& path);
  OutFolder(OutFolder&& other) noexcept;
  OutFolder& operator=(OutFolder&& other) = delete;
  ~OutFolder();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Refuses files of these names that are in it already.
  [[nodiscard]] Status check_absent(const std::vector<std::string>& names) const;
  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  OutFolder(std::filesystem::path path, std::vector<std::filesystem::path> made)
      : path_(std::move(path)), made_(std::move(made)) {}

  std::filesystem::path path_;
  std::vector<std::filesystem::path> made_;  ///< by this object, the innermost first
};

}  // namespace orthonav::tools
