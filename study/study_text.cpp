#include "study/study_text.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/how_many.h"
#include "base/printed.h"
#include "study/study_totals.h"

namespace orthonav::engine {
namespace {

/// To this many columns; UTF-8's continuation bytes take none.
std::string padded(std::string text, std::ptrdiff_t columns) {
  const auto width = std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  });
  text.append(static_cast<std::size_t>(std::max<std::ptrdiff_t>(columns - width, 1)), ' ');
  return text;
}

std::string line(const nlohmann::json& row) {
  const std::string unit = row["unit"];
  const int count = row["count"];
  const auto number = [&row](const char* key) { return row[key].get<double>(); };
  std::string text =
      padded(row["name"].get<std::string>() + (unit.empty() ? "" : ", " + unit), 26) +
      padded(std::to_string(count), 7);
  text += padded(count == 0 ? "-" : printed("%.2f ± %.2f", number("mean"), number("sd")), 20);
  text += padded(count == 0 ? "-" : printed("%.2f to %.2f", number("min"), number("max")), 22);
  return text + printed("%.2f ± %.2f\n", number("paper_mean"), number("paper_sd"));
}

}  // namespace

std::string study_table(const std::string& study_text) {
  const auto study = nlohmann::json::parse(study_text);
  std::string out = "method " + study["method"].get<std::string>() + ": " +
                    std::to_string(study["completed"].get<int>()) + " of " +
                    how_many(study["operations"].get<std::size_t>(), "operation") + " completed\n" +
                    padded("", 26) + padded("n", 7) + padded("mean ± SD", 20) +
                    padded("from, to", 22) + "Liebmann et al. 2019\n";
  for (const auto& row : study["table"]) {
    out += line(row);
  }
  const auto& silent = study["registrations"]["silent_failures"];
  return out + "Registrations that passed and are more than " +
         printed("%.1f", silent["over_mm"].get<double>()) +
         " mm off: " + std::to_string(silent["n"].get<int>()) + " of " +
         std::to_string(silent["of"].get<int>()) + "\n";
}

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
