#pragma once

#include <string>
#include <string_view>

#include "base/result.h"

namespace orthonav {

/// A file in memory, for libraries that can only read from a path, and for another process.
class MemoryFile {
 public:
  static Result<MemoryFile> create(std::string_view content = {});
  MemoryFile(MemoryFile&& other) noexcept;
  MemoryFile& operator=(MemoryFile&&) = delete;
  ~MemoryFile();
  [[nodiscard]] std::string path() const;
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  int descriptor_ = -1;
  explicit MemoryFile(int descriptor) : descriptor_(descriptor) {}
};

}  // namespace orthonav
