#include "hal/sim/room/instruments.h"

#include <algorithm>
#include <array>

#include "base/joined.h"

namespace orthonav::sim {
namespace {

struct Instrument {
  std::string_view name;
  double bending_rad;
  double skiving_m;
  double hole_following_rad;
  bool by_hand;
};

// The middles of the ranges in magnitudes.cpp.
constexpr std::array<Instrument, 5> kInstruments = {{
    {"wire", 0.030, 0.0004, 0.0, true},
    {"cannula", 0.008, 0.0004, 0.0, true},
    {"sleeved drill", 0.008, 0.0004, 0.0, true},
    {"screw", 0.008, 0.0004, 0.035, true},
    {"robot arm", 0.008, 0.0004, 0.0, false},
}};

}  // namespace

std::vector<std::string> instrument_names() {
  std::vector<std::string> names;
  for (const Instrument& instrument : kInstruments) {
    names.emplace_back(instrument.name);
  }
  return names;
}

Status use_instrument(std::string_view name, ErrorModel& error_model) {
  const auto* found = std::find_if(kInstruments.begin(), kInstruments.end(),
                                   [&](const Instrument& i) { return i.name == name; });
  if (found == kInstruments.end()) {
    return Error{"instrument '" + std::string(name) +
                 "': unknown (known: " + joined(instrument_names(), ", ") + ")"};
  }
  error_model.wire_bending_rad = found->bending_rad;
  error_model.wire_skiving_m = found->skiving_m;
  error_model.hole_following_rad = found->hole_following_rad;
  if (!found->by_hand) {
    for (double ErrorModel::*of_a_hand :
         {&ErrorModel::tremor_m, &ErrorModel::tremor_rad, &ErrorModel::entry_pick_m,
          &ErrorModel::overlay_perception_m, &ErrorModel::angle_reading_rad,
          &ErrorModel::misreading_probability, &ErrorModel::hand_drilling_rad,
          &ErrorModel::hand_drilling_corrected_rad}) {
      error_model.*of_a_hand = 0.0;
    }
  }
  return {};
}

void use_measured_strokes(ErrorModel& error_model) {
  // The absolute value of a normal height has 0.80 of its RMS as mean and 0.60 as SD.
  error_model.stroke_lift_m = 0.00053;
  // With it, heights 8, 15 and 31 mm apart on a stroke correlate about as measured, less what other
  // strokes share with them.
  error_model.stroke_lift_length_m = 0.26;
}

}  // namespace orthonav::sim
