#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.h"

namespace orthonav::engine {

/// Where what is not whole yet lies.
enum class Staging : std::uint8_t {
  /// In a file without a name (O_TMPFILE), which goes away with the process however that ends.
  /// Where the file system has no such files, kBeside.
  kNameless,
  kBeside,  ///< in the same folder, as STEM.part-PROCESS-N.EXTENSION
};

/// A file that appears completely or not at all: `commit` gives it its name; without a commit
/// nothing is left. A name that is no regular file (a terminal, a pipe) is written in place; a
/// symbolic link is followed, not replaced.
class AtomicFile {
 public:
  /// Refuses an empty name, a missing or unwritable folder, and a folder in the file's place.
  static Result<AtomicFile> create(const std::string& path, Staging staging = Staging::kNameless);
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&& other) noexcept;
  ~AtomicFile();

  /// Where to write until the commit: to be opened by this process alone.
  [[nodiscard]] const std::string& temporary_path() const { return temporary_path_; }
  [[nodiscard]] const std::string& final_path() const { return final_path_; }
  /// Leaves what was written where it is; false where that has no name. No commit may follow.
  bool keep();
  /// Makes what was written durable, gives the file its name, and makes the name durable.
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

/// Writes `content` as the whole file.
Status write_file(const std::string& path, std::string_view content);

}  // namespace orthonav::engine
