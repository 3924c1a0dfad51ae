#pragma once

#include <string>
#include <string_view>

#include "base/result.h"

namespace orthonav::engine {

/// A file that appears completely or not at all: it is written beside its final name (same folder,
/// same extension) and renamed by `commit`; without a commit nothing is left. A name that is no
/// regular file (a terminal, a pipe) is written in place; a symbolic link is followed, not
/// replaced.
class AtomicFile {
 public:
  /// Refuses an empty name, a missing or unwritable folder, and a folder in the file's place.
  static Result<AtomicFile> create(const std::string& path);
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&& other) noexcept;
  ~AtomicFile();

  /// Where to write until the commit.
  [[nodiscard]] const std::string& temporary_path() const { return temporary_path_; }
  [[nodiscard]] const std::string& final_path() const { return final_path_; }
  /// Makes what was written durable and gives the file its name.
  Status commit();

 private:
  AtomicFile(std::string temporary_path, std::string final_path)
      : temporary_path_(std::move(temporary_path)), final_path_(std::move(final_path)) {}
  void drop() noexcept;

  std::string temporary_path_;
  std::string final_path_;
  bool open_ = true;
};

/// Writes `content` as the whole file.
Status write_file(const std::string& path, std::string_view content);

}  // namespace orthonav::engine
