#pragma once

#include <string>
#include <vector>

#include "hal/hl2ss/options.h"

namespace orthonav::hl2ss {

/// Whether one port of a headset accepts a connection.
struct ProbedPort {
  std::string name;  ///< "left camera"
  Service service = Service::kLeftFront;
  int port = 0;
  std::string trouble;  ///< empty: it accepts
};

/// Connects to each port that we use and disconnects again without a request. Blocks for at most a
/// second per port. An Error if the host is unknown.
Result<std::vector<ProbedPort>> probe(const Hl2ssOptions& options);

}  // namespace orthonav::hl2ss
