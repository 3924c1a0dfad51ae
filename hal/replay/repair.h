#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "base/result.h"

namespace orthonav::replay {

struct RepairReport {
  std::int64_t pairs = 0;
  std::string cut;               ///< in one line, where it had been cut off; empty: it was whole
  std::filesystem::path folder;  ///< what the recording is called now
};

/// Closes a recording that was cut off, in its place: what lies behind the last whole pair and the
/// last whole line is dropped, archives get their end marks, and a folder that our recorder left
/// under its temporary name gets its own. Changes nothing where there is no whole pair or where the
/// name is taken. Called again after it was cut off itself, it goes on.
Result<RepairReport> repair_recording(const std::filesystem::path& folder);

}  // namespace orthonav::replay
