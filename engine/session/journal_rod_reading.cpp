#include "engine/session/journal_rod_reading.h"

#include <algorithm>

#include "base/angle.h"
#include "base/units.h"
#include "engine/session/journal_screw_reading.h"

namespace orthonav::engine {

std::size_t count_of(const JsonNode& line, const char* key) {
  const int count = line.integer(key);
  if (count < 0) {
    line.refuse(key, "is negative");
  }
  return static_cast<std::size_t>(std::max(0, count));
}

std::size_t heads_after(const JsonNode& line, bool touched, std::size_t heads) {
  const std::size_t touches = line.has("touches") ? count_of(line, "touches") : touched ? 1 : 0;
  if (touched) {
    return touches == 1 ? heads + 1 : heads;
  }
  return touches == 0 && heads > 0 ? heads - 1 : heads;
}

RecordedRod recorded_rod_of(const JsonNode& line) {
  RecordedRod rod;
  rod.side = side_of(line);
  rod.heads = count_of(line, "heads");
  rod.done = true;
  rod.length_m = optional_number(line, "length_mm", kMetresPerMm);
  if (line.has("bends")) {
    for (const JsonNode& bend : line.list("bends")) {
      rod.bends.push_back({bend.number("arc_length_mm") * kMetresPerMm,
                           bend.number("angle_deg") * kRadiansPerDegree});
    }
  }
  rod.cut_length_m = optional_number(line, "cut_length_mm", kMetresPerMm);
  rod.no_instructions = line.text_or("no_instructions", "");
  if (line.has("instructions")) {
    for (const JsonNode& bend : line.list("instructions")) {
      rod.instructions.push_back({bend.number("arc_length_mm") * kMetresPerMm,
                                  bend.number("roll_deg") * kRadiansPerDegree,
                                  bend.number("angle_deg") * kRadiansPerDegree,
                                  bend.number("set_deg") * kRadiansPerDegree});
    }
  }
  if (line.has("touched")) {
    for (const JsonNode& head : line.list("touched")) {
      rod.touched.push_back({count_of(head, "touches"), head.number("sd_mm") * kMetresPerMm});
    }
  }
  rod.expected_within = optional_number(line, "expected_within_share");
  return rod;
}

}  // namespace orthonav::engine
