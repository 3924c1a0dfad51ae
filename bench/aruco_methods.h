#pragma once

#include <vector>

#include "bench/tracking_methods.h"

namespace orthonav::bench {

/// OpenCV's ArUco detector with the dictionary of tag36h11 and each of its corner refinements; none
/// where the bench was built without it.
void add_aruco_methods(std::vector<Method>& methods);

}  // namespace orthonav::bench
