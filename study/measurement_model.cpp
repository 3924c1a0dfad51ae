#include "study/measurement_model.h"

namespace orthonav::engine {

MeasurementModel MeasurementModel::of(std::string_view method) {
  MeasurementModel model;
  if (method == "paper") {
    model.white_px = 0.042;
    model.lasting_px = 0.012;
    model.of_blur = 0.02;
    model.believed_px = 0.1;
    model.drop_hides = true;
  }
  return model;
}

}  // namespace orthonav::engine
