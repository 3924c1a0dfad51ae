#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace orthonav::engine {

/// A file that only grows at its end.
class AppendFile {
 public:
  virtual ~AppendFile() = default;
  /// Appends all of the bytes; after an Error any part of them may be in the file.
  virtual Status append(std::string_view bytes) = 0;
  /// On success everything appended survives a loss of power. After an Error it is unknown what
  /// does, and a later success guarantees nothing written before it, since the kernel may have
  /// dropped that.
  virtual Status sync() = 0;
};

/// A lock held until it is destroyed or its process ends.
class FolderLock {
 public:
  virtual ~FolderLock() = default;
};

/// The only access to the file system for data that must not be lost. A file's name is durable once
/// its folder is synced, its content once the file is.
class Env {
 public:
  virtual ~Env() = default;
  /// Creates the file if it does not exist.
  virtual Result<std::unique_ptr<AppendFile>> open_append(const std::string& path) = 0;
  /// `kNotFound` if there is no such file; refuses more than `most_bytes`.
  virtual Result<std::string> read(const std::string& path, std::size_t most_bytes) = 0;
  /// The names in a folder, sorted.
  virtual Result<std::vector<std::string>> list(const std::string& folder) = 0;
  /// Atomically; a file already named `to` is replaced.
  virtual Status rename(const std::string& from, const std::string& to) = 0;
  virtual Status truncate(const std::string& path, std::size_t bytes) = 0;
  /// `kNotFound` if there is no such file.
  virtual Status remove(const std::string& path) = 0;
  virtual Status sync_folder(const std::string& folder) = 0;
  /// Refuses a folder that is locked already, by this process or another.
  virtual Result<std::unique_ptr<FolderLock>> lock(const std::string& folder) = 0;
};

/// "FOLDER: is in use by another operation".
[[nodiscard]] Error folder_in_use(const std::string& folder);

}  // namespace orthonav::engine
