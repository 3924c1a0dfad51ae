#include "tools/orthonav/run/connection_report.h"

#include "base/how_many.h"
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
    text += printed("%-14s %s in %s, jitter %.2f ms, %s (longest %.0f ms), %lld damaged",
                    stream.name.c_str(), how_many(stream.packets, "packet").c_str(),
                    how_many(stream.connections, "connection").c_str(), stream.jitter_ms,
                    how_many(stream.gaps, "gap").c_str(), seconds(stream.longest_gap) * 1e3,
                    static_cast<long long>(stream.damaged));
    if (stream.out_of_order > 0) {
      text += printed(", %lld out of order", static_cast<long long>(stream.out_of_order));
    }
    text += "\n";
    if (!stream.last_trouble.empty()) {
      text += "  last trouble: " + stream.last_trouble + "\n";
    }
  }
  text += printed("%-14s %s, %lld dropped for newer ones, %s without a partner\n", "stereo",
                  how_many(s.pairs, "pair").c_str(), static_cast<long long>(s.dropped),
                  how_many(s.unpaired, "image").c_str());
  text += "map moved " + how_many(s.map_moves, "time") + ", headset's clock restarted " +
          how_many(s.clock_restarts, "time") + "\n";
  text += printed("headset's clock minus this machine's: %.6f s, spread %.3f ms\n",
                  seconds(s.clock_offset), s.clock_spread_ms);
  text += latency_line("last byte received to pair published", s.publish_ms);
  text += latency_line("last byte received to pair taken", s.take_ms);
  return text;
}

}  // namespace orthonav::tools
