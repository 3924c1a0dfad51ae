#include "base/length_text.h"

#include <cmath>

#include "base/printed.h"

namespace orthonav {

std::string in_mm(double length_m, int decimals) {
  return printed("%.*f mm", decimals, length_m * 1e3);
}

void append_mm(std::string& out, double length_m, int decimals) {
  if (!std::isfinite(length_m)) {
    out += "-- mm";
    return;
  }
  append_printed(out, "%.*f mm", decimals, length_m * 1e3);
}

std::string in_mm_outside(double length_m, double least_m, double most_m, int decimals) {
  const double limit_m = length_m < least_m ? least_m : most_m;
  return value_beside(length_m * 1e3, limit_m * 1e3, decimals) + " mm";
}

}  // namespace orthonav
