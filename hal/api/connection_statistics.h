#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/time.h"

namespace orthonav {

/// Statistics of one stream of a connection so far.
struct StreamStatistics {
  std::string name;
  std::int64_t connections = 0;
  std::int64_t packets = 0;
  std::int64_t bytes = 0;
  std::int64_t damaged = 0;  ///< packets refused because of their own or their picture's damage
  std::int64_t out_of_order = 0;  ///< poses of a tracker dated before their predecessor
  std::int64_t gaps = 0;          ///< stamps more than one and a half intervals apart
  Duration longest_gap{};         ///< between two stamps
  /// Mean deviation of the transit time from packet to packet (RFC 3550, 6.4.1).
  double jitter_ms = 0.0;
  std::string last_trouble;
};

/// Statistics of a headset's connection so far.
struct ConnectionStatistics {
  std::vector<StreamStatistics> streams;
  std::int64_t pairs = 0;
  std::int64_t unpaired = 0;  ///< images without a partner
  std::int64_t dropped = 0;   ///< pairs replaced by a newer one before they were taken
  std::int64_t map_moves = 0;
  std::int64_t clock_restarts = 0;
  /// Headset's clock minus this machine's steady clock, from the packet with the shortest transit
  /// time.
  Duration clock_offset{};
  double clock_spread_ms = 0.0;  ///< of that offset over the last seconds, largest minus smallest
  /// For the last pairs: from the last byte of a pair to its publication, and until it was taken.
  std::vector<double> publish_ms;
  std::vector<double> take_ms;
};

}  // namespace orthonav
