#include "engine/io/patient_axes.h"

namespace orthonav::engine {

std::optional<Axes> axes_from(const std::string& text) {
  if (text == "LPS") {
    return Axes::kLps;
  }
  if (text == "RAS") {
    return Axes::kRas;
  }
  return std::nullopt;
}

std::optional<double> metres_per_unit_from(const std::string& text) {
  if (text == "mm") {
    return 1e-3;
  }
  if (text == "m") {
    return 1.0;
  }
  return std::nullopt;
}

}  // namespace orthonav::engine
