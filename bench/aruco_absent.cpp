#include "bench/aruco_methods.h"

namespace orthonav::bench {

std::vector<NamedDetect> aruco_detectors(const std::string& /*family*/) { return {}; }

}  // namespace orthonav::bench
