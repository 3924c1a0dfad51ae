#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace orthonav::engine {

/// A file to whose end more is written.
class AppendFile {
 public:
  virtual ~AppendFile() = default;
  /// All of the bytes; after an Error any part of them may be in the file.
  virtual Status append(std::string_view bytes) = 0;
  /// What was appended survives a loss of power. After an Error nobody knows what does, and a later
  /// success says nothing of what was appended before: the kernel may have dropped it.
  virtual Status sync() = 0;
};

/// Held as long as it lives, and no longer than its process.
class FolderLock {
 public:
  virtual ~FolderLock() = default;
};

/// The one door through which what must not be lost reaches the file system. A name is durable once
/// its folder was synced, what is in the file once the file was.
class Env {
 public:
  virtual ~Env() = default;
  /// Makes the file where there is none.
  virtual Result<std::unique_ptr<AppendFile>> open_append(const std::string& path) = 0;
  /// `kNotFound` where there is no such file; refuses more than `most_bytes`.
  virtual Result<std::string> read(const std::string& path, std::size_t most_bytes) = 0;
  /// The names in a folder, sorted.
  virtual Result<std::vector<std::string>> list(const std::string& folder) = 0;
  /// In one step; whatever had the name `to` is gone.
  virtual Status rename(const std::string& from, const std::string& to) = 0;
  virtual Status truncate(const std::string& path, std::size_t bytes) = 0;
  /// `kNotFound` where there is no such file.
  virtual Status remove(const std::string& path) = 0;
  virtual Status sync_folder(const std::string& folder) = 0;
  /// Refuses a folder that another process, or another lock, holds.
  virtual Result<std::unique_ptr<FolderLock>> lock(const std::string& folder) = 0;
};

/// "PATH: cannot be written: No space left on device".
[[nodiscard]] Error file_error(const std::string& path, const char* doing, int error_number);
/// "FOLDER: is in use by another operation".
[[nodiscard]] Error folder_in_use(const std::string& folder);

/// The folder that a path names a file in.
[[nodiscard]] std::string folder_of(const std::string& path);

}  // namespace orthonav::engine
