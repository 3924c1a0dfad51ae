#include "engine/study/study_text.h"

#include <nlohmann/json.hpp>

#include "engine/study/study_totals.h"

namespace orthonav::engine {

std::string study_text(const std::string& method, const nlohmann::ordered_json& runs,
                       const nlohmann::ordered_json& failed, std::size_t planned) {
  StudyTotals totals;
  for (const nlohmann::ordered_json& run : runs) {
    totals.add(run);
  }
  return text_of(totals.study(method, runs, failed, planned)) + "\n";
}

std::string text_of(const nlohmann::ordered_json& part) {
  return part.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace orthonav::engine
