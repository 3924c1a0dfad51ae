#pragma once

#include <vector>

#include "bench/tracking_methods.h"

namespace orthonav::bench {

/// Adds OpenCV's ArUco detector with the dictionary of tag36h11, once per corner refinement;
/// nothing if the benchmark was built without it.
void add_aruco_methods(std::vector<Method>& methods);

}  // namespace orthonav::bench
