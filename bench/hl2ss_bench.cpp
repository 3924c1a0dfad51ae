// Half an hour of a headset over TCP, as fast as possible: the cost of a pair from its last byte
// on, and whether memory grows. Usage: bench_hl2ss [SECONDS of headset time, default 1800]
// [raw|h264]

#include <unistd.h>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

#include "bench/quantile.h"
#include "hal/api/as_headset.h"
#include "hal/hl2ss/hl2ss_headset.h"
#include "hal/hl2ss/server/server.h"
#include "hal/sim/sim_headset.h"
#include "tests/support/bare_room.h"

namespace orthonav {
namespace {

double resident_mib() {
  std::ifstream in("/proc/self/statm");
  long pages = 0;
  long resident = 0;
  in >> pages >> resident;
  return static_cast<double>(resident) * static_cast<double>(::sysconf(_SC_PAGESIZE)) / 1048576.0;
}

int measure(double limit_s, hl2ss::VideoProfile profile) {
  const sim::RoomDescription room = orthonav::test::bare_room();
  sim::SimOptions sim;
  sim.render = false;
  sim.limit_s = limit_s;
  hl2ss::ServerOptions options;
  options.first_port = 0;
  options.paced = true;
  auto server =
      hl2ss::Server::start(options, [&] { return as_headset(sim::SimHeadset::open(room, sim)); });
  if (!server) {
    return std::fprintf(stderr, "%s\n", server.error().message.c_str()), 2;
  }
  hl2ss::Hl2ssOptions client = (*server)->client_options();
  client.profile = profile;
  auto headset = hl2ss::Hl2ssHeadset::open(client);
  if (!headset) {
    return std::fprintf(stderr, "%s\n", headset.error().message.c_str()), 2;
  }
  StereoFrame frame;
  std::int64_t pairs = 0;
  double warm_mib = 0.0;
  double most_mib = 0.0;
  for (;;) {
    const auto next = (*headset)->cameras()->next(frame);
    if (next && *next == Next::kEnd) {
      break;
    }
    if (!next || *next == Next::kNone) {
      std::this_thread::sleep_for(std::chrono::microseconds(100));
      continue;
    }
    ++pairs;
    if (pairs == 1000) {
      warm_mib = resident_mib();
    }
    if (pairs % 1000 == 0) {
      most_mib = std::max(most_mib, resident_mib());
    }
  }
  const ConnectionStatistics figures = (*headset)->statistics();
  std::printf(
      "%lld pairs; resident after 1000 pairs %.1f MiB, most %.1f MiB, at the end %.1f MiB\n",
      static_cast<long long>(pairs), warm_mib, most_mib, resident_mib());
  std::printf("last byte to pair published: median %.3f ms, p99 %.3f ms, most %.3f ms\n",
              quantile(figures.publish_ms, 0.5), quantile(figures.publish_ms, 0.99),
              quantile(figures.publish_ms, 1.0));
  std::printf("last byte to pair taken:     median %.3f ms, p99 %.3f ms, most %.3f ms\n",
              quantile(figures.take_ms, 0.5), quantile(figures.take_ms, 0.99),
              quantile(figures.take_ms, 1.0));
  return 0;
}

}  // namespace
}  // namespace orthonav

int main(int argc, char** argv) {
  const double limit_s = argc > 1 ? std::atof(argv[1]) : 1800.0;
  const bool h264 = argc > 2 && std::string(argv[2]) == "h264";
  return orthonav::measure(limit_s, h264 ? orthonav::hl2ss::VideoProfile::kH264Base
                                         : orthonav::hl2ss::VideoProfile::kRaw);
}
