#include "tools/orthonav/run/run_stats.h"

#include <cstdio>

#include "base/how_many.h"
#include "study/evaluation.h"

namespace orthonav::tools {
namespace {

void print_times(const char* what, const Histogram& ms) {
  if (!ms.empty()) {
    std::fprintf(stderr, "%-28s %8.1f ms, p99 %8.1f ms\n", what, *ms.quantile(0.5),
                 *ms.quantile(0.99));
  }
}

void print_times(const char* what, const std::vector<double>& ms) {
  const auto median = engine::quantile(ms, 0.5);
  const auto p99 = engine::quantile(ms, 0.99);
  if (median && p99) {
    std::fprintf(stderr, "%-28s %8.1f ms, p99 %8.1f ms\n", what, *median, *p99);
  }
}

}  // namespace

void print_stats(const engine::LoopReport& loop) {
  print_times("between frames", loop.intervals_ms);
  print_times("capture to photon", loop.photon_ages_ms);
  print_times("tracking a pair (wall clock)", loop.step_wall_ms);
}

void print_stats(const engine::PresentReport& report) {
  std::fprintf(stderr, "%-28s %lld asked for, %lld drawn, %lld with guidance too old\n",
               "display frames", static_cast<long long>(report.frames),
               static_cast<long long>(report.drawn), static_cast<long long>(report.hidden));
  print_times("head pose to submission", report.latch_ms);
  std::fprintf(stderr, "%-28s %.1f ms, %s late, %s without a frame\n", "display period",
               1e3 * seconds(report.period), how_many(report.late, "frame").c_str(),
               how_many(report.missed, "period").c_str());
  print_times("waiting for a frame", report.wait_ms);
  print_times("submitting a frame", report.submit_ms);
  std::fprintf(stderr, "%-28s drawn %s\n", "panel of the status line",
               how_many(report.panel_draws, "time").c_str());
}

void print_stats(const ObjectDisplayStatistics& objects) {
  std::fprintf(
      stderr,
      "%-28s %lld now, %s, %s, %s, %lld refused, %lld left out, %s, %lld abandoned, guidance in "
      "%s, "
      "too old in %lld\n",
      "objects on the headset", static_cast<long long>(objects.objects),
      how_many(objects.lists, "list").c_str(), how_many(objects.commands, "command").c_str(),
      how_many(objects.bytes, "byte").c_str(), static_cast<long long>(objects.refused),
      static_cast<long long>(objects.left_out), how_many(objects.connections, "connection").c_str(),
      static_cast<long long>(objects.given_up),
      how_many(objects.shown_age_ms.size(), "acknowledged list").c_str(),
      static_cast<long long>(objects.withheld));
  print_times("list to acknowledgement", objects.acknowledged_ms);
  print_times("pair to acknowledgement", objects.shown_age_ms);
}

}  // namespace orthonav::tools
