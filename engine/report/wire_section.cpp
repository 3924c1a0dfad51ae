#include "engine/report/wire_section.h"

#include <nlohmann/json.hpp>

#include "engine/report/html_text.h"
#include "engine/report/report_values.h"

namespace orthonav::engine {
namespace {

std::string with_sd(const nlohmann::json& wire, const char* key, const char* sd_key) {
  return figure(wire, key, 1) + " \u00b1 " + figure(wire, sd_key, 1);
}

}  // namespace

std::string wire_as_placed(const nlohmann::json& screw) {
  std::string text = "\u2013";
  if (screw.is_object() && screw.contains("wire")) {
    const nlohmann::json& wire = screw["wire"];
    if (wire.is_object()) {
      text = with_sd(wire, "angle_deg", "angle_sd_deg") + "\u00b0, " +
             with_sd(wire, "entry_mm", "entry_sd_mm") + " mm" +
             (is_true(wire, "kept") ? ", kept" : "");
    } else if (wire.is_string()) {
      text = html_escaped(wire.get<std::string>());
    }
  }
  return text + (value_of(screw, "redone").value_or(0.0) > 0.0 ? "; redone" : "");
}

}  // namespace orthonav::engine
