#include "tests/soak/memory_curve.h"

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace orthonav::soak {

std::int64_t resident_kib() {
  ::malloc_trim(0);
  std::ifstream statm("/proc/self/statm");
  std::int64_t total = 0;
  std::int64_t resident = 0;
  statm >> total >> resident;
  return resident * ::sysconf(_SC_PAGESIZE) / 1024;
}

double growth_kib(const std::vector<double>& resident_kib) {
  std::vector<double> slopes;
  for (std::size_t i = 0; i < resident_kib.size(); ++i) {
    for (std::size_t k = i + 1; k < resident_kib.size(); ++k) {
      slopes.push_back((resident_kib[k] - resident_kib[i]) / static_cast<double>(k - i));
    }
  }
  if (slopes.empty()) {
    return 0.0;
  }
  const auto middle = slopes.begin() + static_cast<std::ptrdiff_t>(slopes.size() / 2);
  std::nth_element(slopes.begin(), middle, slopes.end());
  return *middle;
}

}  // namespace orthonav::soak
