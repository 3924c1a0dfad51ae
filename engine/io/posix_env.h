#pragma once

#include "engine/io/env.h"

namespace orthonav::engine {

/// The file system of this machine.
class PosixEnv : public Env {
 public:
  Result<std::unique_ptr<AppendFile>> open_append(const std::string& path) override;
  Result<std::string> read(const std::string& path, std::size_t most_bytes) override;
  Result<std::vector<std::string>> list(const std::string& folder) override;
  Status rename(const std::string& from, const std::string& to) override;
  Status truncate(const std::string& path, std::size_t bytes) override;
  Status remove(const std::string& path) override;
  Status sync_folder(const std::string& folder) override;
  Result<std::unique_ptr<FolderLock>> lock(const std::string& folder) override;
};

}  // namespace orthonav::engine
