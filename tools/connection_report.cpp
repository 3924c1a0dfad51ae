#include "tools/connection_report.h"

#include "base/printed.h"
#include "engine/report/operation_result.h"

namespace orthonav::tools {
namespace {

std::string latency_line(const char* what, const std::vector<double>& ms) {
  const auto median = engine::quantile(ms, 0.5);
  const auto p99 = engine::quantile(ms, 0.99);
  if (!median || !p99) {
    return {};
  }
  return printed("%-40s %8.2f ms, p99 %8.2f ms\n", what, *median, *p99);
}

}  // namespace

std::string connection_report(const ConnectionStatistics& s) {
  std::string text;
  for (const StreamStatistics& stream : s.streams) {
    text += printed(
        "%-14s %8lld packets, %4lld connections, jitter %6.2f ms, %lld gaps (longest %.0f ms), "
        "%lld "
        "out of order, %lld damaged\n",
        stream.name.c_str(), static_cast<long long>(stream.packets),
        static_cast<long long>(stream.connections), stream.jitter_ms,
        static_cast<long long>(stream.gaps), seconds(stream.longest_gap) * 1e3,
        static_cast<long long>(stream.out_of_order), static_cast<long long>(stream.damaged));
    if (!stream.last_trouble.empty()) {
      text += "  last trouble: " + stream.last_trouble + "\n";
    }
  }
  text +=
      printed("pairs          %8lld, %lld images without a partner, %lld pairs dropped for newer\n",
              static_cast<long long>(s.pairs), static_cast<long long>(s.unpaired),
              static_cast<long long>(s.dropped));
  text += printed("map moved %lld times, headset's clock began anew %lld times\n",
                  static_cast<long long>(s.map_moves), static_cast<long long>(s.clock_restarts));
  text += printed("headset's clock minus this machine's: %.6f s, spread %.3f ms\n",
                  seconds(s.clock_offset), s.clock_spread_ms);
  text += latency_line("last byte received to pair published", s.publish_ms);
  text += latency_line("last byte received to pair taken", s.take_ms);
  return text;
}

}  // namespace orthonav::tools
