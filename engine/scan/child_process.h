#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>

#include "base/memory_file.h"
#include "base/result.h"

namespace orthonav::engine {

/// What a child process wrote, mapped into memory.
class ChildBytes {
 public:
  /// Maps the file, which may then be closed; nothing where it is empty or can't be mapped.
  explicit ChildBytes(const MemoryFile& file);
  ~ChildBytes();
  ChildBytes(ChildBytes&& other) noexcept;
  ChildBytes& operator=(ChildBytes&& other) noexcept;
  ChildBytes(const ChildBytes&) = delete;
  ChildBytes& operator=(const ChildBytes&) = delete;

  [[nodiscard]] std::string_view view() const { return {bytes_, size_}; }

 private:
  const char* bytes_ = nullptr;
  std::size_t size_ = 0;
};

/// What a child process may use, beyond what its parent has.
struct ChildLimits {
  std::chrono::seconds processor{0};
  std::uint64_t memory_bytes = 0;
};

/// Runs `work` in a child process and returns what it wrote to the file it is given. For libraries
/// that end a program when a file is damaged, by an assertion or a crash, or find no end: only the
/// child ends. It prints nothing and leaves no core dump. Refuses in words that follow a file's
/// name, where the child ended in any other way than by returning true.
Result<ChildBytes> bytes_from_child(const ChildLimits& limits,
                                    const std::function<bool(int file)>& work);

}  // namespace orthonav::engine
