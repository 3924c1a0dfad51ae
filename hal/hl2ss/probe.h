#pragma once

#include <string>
#include <vector>

#include "hal/hl2ss/options.h"

namespace orthonav::hl2ss {

/// Whether one port of a headset lets us in.
struct ProbedPort {
  std::string name;  ///< "left camera"
  Service service = Service::kLeftFront;
  int port = 0;
  std::string trouble;  ///< empty: it does
};

/// Connects to each port that we use and leaves again; asks for nothing. Blocks for a second a port
/// at most. An Error when the host is not known.
Result<std::vector<ProbedPort>> probe(const Hl2ssOptions& options);

}  // namespace orthonav::hl2ss
