#include "engine/report/wire_section.h"

#include <nlohmann/json.hpp>

#include "engine/report/html_text.h"
#include "engine/report/report_values.h"

namespace orthonav::engine {
namespace {

std::string with_sd(const nlohmann::json& wire, const char* key, const char* sd_key) {
  const auto value = value_of(wire, key);
  const auto sd = value_of(wire, sd_key);
  return (value ? html_number(*value, 1) : "\u2013") + " \u00b1 " +
         (sd ? html_number(*sd, 1) : "\u2013");
}

bool says(const nlohmann::json& object, const char* key) {
  return object.contains(key) && object[key].is_boolean() && object[key].get<bool>();
}

}  // namespace

std::string wire_as_placed(const nlohmann::json& screw) {
  std::string text = "\u2013";
  if (screw.is_object() && screw.contains("wire")) {
    const nlohmann::json& wire = screw["wire"];
    if (wire.is_object()) {
      text = with_sd(wire, "angle_deg", "angle_sd_deg") + "\u00b0, " +
             with_sd(wire, "entry_mm", "entry_sd_mm") + " mm" +
             (says(wire, "kept") ? ", kept" : "");
    } else if (wire.is_string()) {
      text = html_escaped(wire.get<std::string>());
    }
  }
  return text + (value_of(screw, "redone").value_or(0.0) > 0.0 ? "; redone" : "");
}

}  // namespace orthonav::engine
