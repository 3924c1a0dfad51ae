#pragma once

#include <string>
#include <vector>

namespace orthonav::test {

/// While it exists, the calls of this program that change a folder's files or make them durable are
/// recorded in order, and one of them can be made to fail. The program links the object
/// orthonav_file_calls, whose functions take the place of the C library's. One at a time.
class FileCalls {
 public:
  /// Watches a folder and everything below it.
  explicit FileCalls(const std::string& folder);
  ~FileCalls();
  FileCalls(const FileCalls&) = delete;
  FileCalls& operator=(const FileCalls&) = delete;

  /// "write a.log", "fsync a.log", "rename a.part a", "fsync ." of the folder itself; a file
  /// without a name is "(nameless)". Failed calls are included.
  [[nodiscard]] static std::vector<std::string> made();
  /// The next call recorded as `call` does nothing and fails with this error; those after it work
  /// again.
  static void fail_next(const std::string& call, int error_number);
  /// From now on a write recorded as `call` waits, as on a disk that hangs; empty: none does any
  /// more.
  static void hold(const std::string& call);
};

}  // namespace orthonav::test
