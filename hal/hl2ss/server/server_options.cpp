#include "hal/hl2ss/server/server.h"

namespace orthonav::hl2ss {
namespace {

/// A slice has at least one row of macroblocks, and enough pixels must keep a direction.
constexpr int kMaxSlices = 30;
constexpr int kMaxUnmappedPx = 100;

}  // namespace

std::vector<std::string> ServerOptions::check() const {
  std::vector<std::string> problems = faults.check();
  if (first_port < 0 || first_port > 65535 - kStandinOffset) {
    problems.push_back("first_port must lie in [0, " + std::to_string(65535 - kStandinOffset) +
                       "]");
  }
  if (paced && !standin) {
    problems.push_back("paced needs standin");
  }
  if (slices < 1 || slices > kMaxSlices) {
    problems.push_back("slices must lie in [1, " + std::to_string(kMaxSlices) + "]");
  }
  if (unmapped_edge_px < 0 || unmapped_edge_px > kMaxUnmappedPx) {
    problems.push_back("unmapped_edge_px must lie in [0, " + std::to_string(kMaxUnmappedPx) + "]");
  }
  return problems;
}

}  // namespace orthonav::hl2ss
