#include "bench/aruco_methods.h"

namespace orthonav::bench {

void add_aruco_methods(std::vector<Method>& /*methods*/) {}

}  // namespace orthonav::bench
