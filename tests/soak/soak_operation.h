#pragma once

#include <cstdint>
#include <string>

#include "engine/case/case.h"
#include "engine/case/operation.h"
#include "tests/soak/flaky_headset.h"
#include "tests/soak/kept_events.h"

namespace orthonav::soak {

/// The result of one operation, over all its attempts.
struct SoakRow {
  std::uint64_t seed = 0;
  double simulated_s = 0.0;
  Troubles troubles{};
  bool full_disk = false;
  bool reference = false;  ///< everything is relative to a patient reference
  int resumed = 0;
  bool completed = false;
  bool recorded = false;   ///< its log has records
  bool not_saved = false;  ///< NOT SAVED was shown
  std::int64_t frames = 0;
  std::int64_t stale = 0;
  std::int64_t stalls = 0;   ///< named by the loop
  Counts kept{};             ///< in its log
  std::int64_t samples = 0;  ///< of the saved regions in its log
  Counts lost{};             ///< missing in the log, though it had to keep them
  std::int64_t lost_samples = 0;
  std::int64_t unsaved = 0;  ///< lost after NOT SAVED was shown
  std::int64_t doubled = 0;  ///< records of events that did not happen, or not as often
  std::int64_t twice = 0;    ///< screws done a second time
  std::string why_not;       ///< why it was not completed, from the last attempt
  std::string trouble;       ///< a fault of the software, if any
};

/// One operation with the faults of this seed, resumed each time its device is lost; its files lie
/// in `folder`.
SoakRow soak_operation(const engine::Case& source, const engine::Operation& planned,
                       std::uint64_t seed, const std::string& folder);

}  // namespace orthonav::soak
