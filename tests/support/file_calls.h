#pragma once

#include <string>
#include <vector>

namespace orthonav::test {

/// While it lives, the calls of this program that change a folder's files or make them durable are
/// told, in their order, and one of them can be made to fail. The program links the object
/// orthonav_file_calls, whose functions take the place of the C library's. One at a time.
class FileCalls {
 public:
  /// Of a folder and what lies below it.
  explicit FileCalls(const std::string& folder);
  ~FileCalls();
  FileCalls(const FileCalls&) = delete;
  FileCalls& operator=(const FileCalls&) = delete;

  /// "write a.log", "fsync a.log", "rename a.part a", "fsync ." of the folder itself; a file
  /// without a name is "(nameless)". Those that failed are among them.
  [[nodiscard]] static std::vector<std::string> made();
  /// The next call told as `call` does nothing and fails like this; those after it are well again.
  static void fail_next(const std::string& call, int error_number);
};

}  // namespace orthonav::test
