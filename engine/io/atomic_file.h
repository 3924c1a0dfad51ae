#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.h"

namespace orthonav::engine {

/// Where an incomplete file is kept.
enum class Staging : std::uint8_t {
  /// In a file without a name (O_TMPFILE), which disappears with the process however that ends. If
  /// the file system does not support this, kBeside.
  kNameless,
  kBeside,  ///< in the same folder, as STEM.part-PROCESS-N.EXTENSION
};

/// A file that appears completely or not at all: `commit` gives it its name; without a commit
/// nothing is left. A path that is not a regular file (a terminal, a pipe) is written in place; a
/// symbolic link is followed, not replaced.
class AtomicFile {
 public:
  /// Refuses an empty name, a missing or unwritable folder, and a folder in the file's place.
  static Result<AtomicFile> create(const std::string& path, Staging staging = Staging::kNameless);
  AtomicFile(AtomicFile&& other) noexcept;
  ~AtomicFile();

  /// Where to write until the commit; only this process may open it.
  [[nodiscard]] const std::string& temporary_path() const { return temporary_path_; }
  [[nodiscard]] const std::string& final_path() const { return final_path_; }
  /// Leaves the temporary file where it is; false if it has no name. No commit may follow.
  bool keep();
  /// Makes the content durable, gives the file its name, and makes the name durable.
  Status commit();

 private:
  AtomicFile(std::string temporary_path, std::string final_path, int nameless = -1)
      : temporary_path_(std::move(temporary_path)),
        final_path_(std::move(final_path)),
        nameless_(nameless) {}
  Status take_a_name();
  void drop() noexcept;

  std::string temporary_path_;
  std::string final_path_;
  int nameless_ = -1;  ///< its descriptor; -1: it has a name, or is written in place
  bool open_ = true;
};

/// Refuses a place where `AtomicFile::create` could make no file, before the work for it. Leaves
/// nothing there.
[[nodiscard]] Status check_place(const std::string& path);

/// Writes `content` as the whole file.
Status write_file(const std::string& path, std::string_view content);

}  // namespace orthonav::engine
