#include "engine/session/rod_wording.h"

#include "base/angle.h"
#include "base/printed.h"
#include "base/translation.h"
#include "engine/session/said.h"

namespace orthonav::engine {

void append_bend(std::string& out, const BendToMake& bend) {
  append_printed(out, translated("bend %zu: %.0f mm, roll %.0f°, set %.1f°"), bend.number,
                 bend.at_m * 1e3, degrees(bend.roll_rad), degrees(bend.set_rad));
}

void append_cut(std::string& out, double length_m) {
  append_printed(out, translated("cut to %s"), said_mm(length_m).c_str());
}

}  // namespace orthonav::engine
