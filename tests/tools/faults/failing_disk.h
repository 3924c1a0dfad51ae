#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace orthonav::test {

/// A call on the disk that is to fail.
struct DiskFault {
  std::string kind;       ///< as tests/support/failing_calls has it
  std::size_t at = 0;     ///< among those of the kind and the name, from 1; 0: none fails
  int problem = 0;        ///< the number of the error
  bool lasting = false;   ///< all later calls fail too, as on a disk that stays full
  std::string name = {};  ///< of its file, or a part of it; empty: any
};

/// A call as it was made.
struct DiskCall {
  std::string kind;
  std::string path;
};

/// False under sanitizers: their runtime must be loaded first, where the failing calls must be.
[[nodiscard]] bool disk_can_fail();
/// Whether ORTHONAV_EVERY_FAULT asks for the tests that take minutes (tools/test --all).
[[nodiscard]] bool every_fault_is_tried();
/// Called in the process of a command before it begins: its disk fails in this way below `folder`.
/// If `list` names a file, its calls are listed there.
void fail_disk(const std::string& folder, const DiskFault& fault, const std::string& list = {});
[[nodiscard]] std::vector<DiskCall> listed_calls(const std::string& list);

}  // namespace orthonav::test
