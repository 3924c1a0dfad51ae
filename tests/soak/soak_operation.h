#pragma once

#include <cstdint>
#include <string>

#include "engine/case/case.h"
#include "engine/case/operation.h"
#include "tests/soak/flaky_headset.h"

namespace orthonav::soak {

/// What became of one operation, over all its attempts.
struct SoakRow {
  std::uint64_t seed = 0;
  double simulated_s = 0.0;
  Troubles troubles{};
  bool full_disk = false;
  int resumed = 0;
  bool completed = false;
  bool recorded = false;   ///< its log holds something
  bool not_saved = false;  ///< and said so
  std::int64_t frames = 0;
  std::int64_t stale = 0;
  std::int64_t stalls = 0;  ///< named by the loop
  std::int64_t screws = 0;  ///< done
  std::int64_t lost = 0;    ///< screws done that the log lacks, though it had to keep them
  std::string why_not;      ///< why it was not completed, as the last attempt says
  std::string trouble;      ///< what should not have happened; empty: nothing
};

/// One operation in bad weather of this seed, resumed each time its device is lost; its files lie
/// in `folder`.
SoakRow soak_operation(const engine::Case& source, const engine::Operation& planned,
                       std::uint64_t seed, const std::string& folder);

}  // namespace orthonav::soak
