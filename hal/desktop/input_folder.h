#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/result.h"

namespace orthonav::desktop {

/// The folder in which the kernel lists input devices, watched for changes (inotify).
class InputFolder {
 public:
  static Result<InputFolder> watch(const std::string& folder);
  InputFolder(InputFolder&& other) noexcept
      : folder_(std::move(other.folder_)), watch_(std::exchange(other.watch_, -1)) {}
  InputFolder& operator=(InputFolder&&) = delete;
  ~InputFolder();
  /// Whether a device appeared, disappeared or changed its permissions since the last call. Does
  /// not block.
  bool changed();
  /// Paths of the event devices, in order of their numbers.
  [[nodiscard]] std::vector<std::string> devices() const;

 private:
  InputFolder(std::string folder, int watch) : folder_(std::move(folder)), watch_(watch) {}

  std::string folder_;
  int watch_ = -1;
};

}  // namespace orthonav::desktop
