#include "study/study_text.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>
#include <utility>
#include <vector>

#include "base/how_many.h"
#include "base/printed.h"
#include "engine/report/paper_table.h"
#include "engine/report/report_values.h"
#include "nav/evaluation/errors.h"
#include "study/clearance_statistics.h"
#include "study/guided_statistics.h"
#include "study/study_statistics.h"

namespace orthonav::engine {
namespace {

using Json = nlohmann::ordered_json;

Json row_json(const PaperRow& row, const std::vector<double>& values) {
  const nav::Summary summary = nav::summarize(values);
  return {{"name", row.name},     {"unit", row.unit},       {"count", summary.count},
          {"mean", summary.mean}, {"sd", summary.sd},       {"min", summary.min},
          {"max", summary.max},   {"paper_mean", row.mean}, {"paper_sd", row.sd}};
}

/// How the errors of accepted registrations compare with their predictions.
Json registrations_json(const RegistrationQuality& quality) {
  return {{"levels", quality.levels},
          {"coverage",
           {{"68", quality.within_68}, {"95", quality.within_95}, {"places", quality.places}}},
          {"silent_failures",
           {{"n", quality.silent},
            {"of", quality.levels},
            {"over_mm", RegistrationQuality::kSilent_m * 1e3},
            {"upper_95", quality.silent_upper_95}}}};
}

/// JSON in the format of a study's file: indented by one space.
std::string text_of(const Json& part) {
  return part.dump(1, ' ', false, Json::error_handler_t::replace);
}

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

Status write_study(const StudyStore& store, std::ostream& out, int shard, int shards) {
  const Json defined = Json::parse(store.definition(), nullptr, false);
  const bool whole = defined.is_object() && defined.contains("method") &&
                     defined.contains("runs") && defined["runs"].is_number_unsigned() &&
                     defined.contains("cases") && defined["cases"].is_array();
  const int all =
      whole ? defined["runs"].get<int>() * static_cast<int>(defined["cases"].size()) : 0;
  if (all == 0) {
    return Error{"study: the definition of what is stored is not one of a study"};
  }
  const int planned = all / shards + (shard - 1 < all % shards ? 1 : 0);
  const auto each = [&](const std::function<Status(const StoredOperation&)>& take) {
    return store.for_each([&](const StoredOperation& operation) {
      return operation.index % shards == shard - 1 ? take(operation) : Status();
    });
  };

  int operations = 0;
  int completed = 0;
  std::array<std::vector<double>, kPaperTable.size()> rows;
  RegistrationCounts registrations;
  ClearanceQuality clearance;
  GuidedQuality guided;
  Json failed = Json::array();
  const Status counted = each([&](const StoredOperation& operation) {
    if (operation.report.empty()) {
      failed.push_back(
          {{"case", operation.case_name}, {"seed", operation.seed}, {"why", operation.why}});
      return Status();
    }
    const Json run = Json::parse(operation.report);
    ++operations;
    completed += run.value("completed", false) ? 1 : 0;
    const nlohmann::json report(run);
    for (std::size_t row = 0; row < rows.size(); ++row) {
      const auto measured = values_of(report, kPaperTable[row].key, kPaperTable[row].per_screw);
      rows[row].insert(rows[row].end(), measured.begin(), measured.end());
    }
    add_run(run, registrations);
    add_run(run, clearance);
    add_run(run, guided);
    return Status();
  });
  if (!counted) {
    return counted;
  }

  Json table = Json::array();
  for (std::size_t row = 0; row < rows.size(); ++row) {
    table.push_back(row_json(kPaperTable[row], rows[row]));
  }
  Json study{{"method", defined["method"]},
             {"operations", operations},
             {"completed", completed},
             {"table", table},
             {"registrations", registrations_json(registrations.quality())},
             {"clearance", clearance_json(clearance)}};
  if (Json figures = guided_json(guided); !figures.is_null()) {
    study["guided"] = std::move(figures);
  }
  study["runs"] = Json::array();
  const int tried = operations + static_cast<int>(failed.size());
  if (!failed.empty()) {
    study["failed"] = std::move(failed);
  }
  if (tried < planned) {
    study["incomplete"] = true;
    study["planned"] = planned;
  }

  const std::string text = text_of(study);
  constexpr std::string_view kRuns = "\n \"runs\": [";
  const std::size_t place = text.find(std::string(kRuns) + "]") + kRuns.size();
  out << text.substr(0, place);
  const char* before = "\n  ";
  const Status written = each([&](const StoredOperation& operation) {
    if (operation.report.empty()) {
      return Status();
    }
    out << std::exchange(before, ",\n  ");
    for (const char c : text_of(Json::parse(operation.report))) {
      out << c << (c == '\n' ? "  " : "");
    }
    return Status();
  });
  if (!written) {
    return written;
  }
  out << (operations > 0 ? "\n " : "") << text.substr(place) << "\n" << std::flush;
  return out ? Status() : Status(Error{"study: its JSON cannot be written", ErrorCode::kIo});
}

Result<std::string> study_text(const StudyStore& store, int shard, int shards) {
  std::ostringstream out;
  const Status written = write_study(store, out, shard, shards);
  return written ? Result<std::string>(out.str()) : Result<std::string>(written.error());
}

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

}  // namespace orthonav::engine
