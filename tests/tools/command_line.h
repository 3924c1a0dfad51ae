#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace orthonav::test {

/// The results of a call of the command.
struct Called {
  int code = -1;  ///< exit code; -1 when it ended by a signal
  std::string out;
  std::string err;
};

/// Runs the built `orthonav` with these arguments, as they are (no shell expands them).
Called orthonav(const std::vector<std::string>& arguments);

/// An empty folder that is deleted again.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }
  /// Writes a file and returns its path.
  [[nodiscard]] std::string with(const std::string& name, const std::string& content) const;
  /// Names in the folder, sorted.
  [[nodiscard]] std::vector<std::string> names() const;

 private:
  std::filesystem::path path_;
};

using orthonav::test::content_of;
/// A file or folder of the test data; empty when it is absent.
std::string shared(const std::string& name);

/// The built `orthonav`, running, for tests that do something to it meanwhile.
class StartedCommand {
 public:
  /// `prepare` is called in the process before the command takes its place: for its environment and
  /// its limits.
  explicit StartedCommand(const std::vector<std::string>& arguments,
                          const std::function<void()>& prepare = {});
  ~StartedCommand();  ///< ends it at once if it was not waited for
  StartedCommand(const StartedCommand&) = delete;
  StartedCommand& operator=(const StartedCommand&) = delete;

  void send(int signal) const;
  [[nodiscard]] pid_t process() const { return child_; }
  /// Whether it already handles SIGTERM instead of being killed by it.
  [[nodiscard]] bool takes_signals() const;
  /// What it has written on standard error until now.
  [[nodiscard]] std::string err_so_far() const;
  Called wait();

 private:
  ScratchFolder folder_;
  pid_t child_ = -1;
};

}  // namespace orthonav::test
