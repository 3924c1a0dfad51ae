#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "base/result.h"

namespace orthonav::replay {

struct RepairReport {
  std::int64_t pairs = 0;
  std::string cut;               ///< in one line, where it was truncated; empty: it was whole
  std::filesystem::path folder;  ///< the recording's path now
};

/// Closes an interrupted recording in place: data after the last whole pair and the last whole line
/// is dropped, archives get their end marks, and a folder that our recorder left under its
/// temporary name is renamed. Changes nothing if there is no whole pair or the name is taken. If
/// the repair itself is interrupted, another call continues it.
Result<RepairReport> repair_recording(const std::filesystem::path& folder);

}  // namespace orthonav::replay
