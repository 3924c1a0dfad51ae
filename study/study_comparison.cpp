#include "study/study_comparison.h"

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/printed.h"
#include "nav/evaluation/errors.h"
#include "study/study_reading.h"
#include "study/two_samples.h"

namespace orthonav::engine {
namespace {

/// The operations of a study by case and seed.
using Operations = std::map<std::pair<std::string, std::uint64_t>, nlohmann::json>;
/// A quantity of an operation by level and side; the side is empty for quantities of a whole level.
using Places = std::map<std::pair<std::string, std::string>, double>;

struct ReadStudy {
  std::string method;
  Operations operations;
};

Result<ReadStudy> read_operations(const std::string& text, const std::string& name) {
  const auto study = parse_study(text, name);
  if (!study) {
    return study.error();
  }
  ReadStudy out{(*study)["method"].get<std::string>(), {}};
  for (const auto& run : (*study)["runs"]) {
    out.operations.try_emplace({run["case"].get<std::string>(), run["seed"].get<std::uint64_t>()},
                               nlohmann::json(run));
  }
  return out;
}

std::string word_of(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

Places places_of(const nlohmann::json& run, const ReportQuantity& quantity) {
  Places places;
  for (const nlohmann::json& level : run["levels"]) {
    const std::string label = word_of(level, "label");
    if (!quantity.per_screw) {
      if (const auto value = value_of(level, quantity.key)) {
        places.try_emplace({label, std::string()}, *value);
      }
      continue;
    }
    for (const nlohmann::json& screw : level.value("screws", nlohmann::json::array())) {
      if (const auto value = value_of(screw, quantity.key)) {
        places.try_emplace({label, word_of(screw, "side")}, *value);
      }
    }
  }
  return places;
}

void take_pairs(const Places& first, const Places& second, PairedOperation operation,
                ComparedQuantity& out) {
  std::vector<double> of_first;
  std::vector<double> of_second;
  for (const auto& [place, value] : first) {
    if (const auto other = second.find(place); other != second.end()) {
      of_first.push_back(value);
      of_second.push_back(other->second);
    }
  }
  if (of_first.empty()) {
    return;
  }
  out.pairs += of_first.size();
  operation.first = nav::summarize(of_first).mean;
  operation.second = nav::summarize(of_second).mean;
  out.operations.push_back(std::move(operation));
}

ComparedQuantity compared(const ReportQuantity& quantity, const Operations& first,
                          const Operations& second) {
  ComparedQuantity out;
  out.quantity = quantity;
  for (const auto& [key, run] : first) {
    if (const auto other = second.find(key); other != second.end()) {
      take_pairs(places_of(run, quantity), places_of(other->second, quantity),
                 {key.first, key.second}, out);
    }
  }
  std::vector<double> of_first;
  std::vector<double> of_second;
  std::vector<double> differences;
  for (const PairedOperation& operation : out.operations) {
    of_first.push_back(operation.first);
    of_second.push_back(operation.second);
    differences.push_back(operation.first - operation.second);
  }
  out.first_mean = nav::summarize(of_first).mean;
  out.second_mean = nav::summarize(of_second).mean;
  out.difference = mean_interval(differences);
  out.equivalent_p = equivalence_p(differences, margin_of(quantity));
  return out;
}

/// Counts the operations that both have, and how many were completed.
void count_operations(const Operations& first, const Operations& second, StudyComparison& out) {
  for (const auto& [key, run] : first) {
    if (const auto other = second.find(key); other != second.end()) {
      ++out.operations;
      out.completed_first += run.value("completed", false) ? 1 : 0;
      out.completed_second += other->second.value("completed", false) ? 1 : 0;
    }
  }
  out.only_first = first.size() - out.operations;
  out.only_second = second.size() - out.operations;
}

std::string interval_text(const MeanInterval& interval, int decimals) {
  return std::isfinite(interval.low)
             ? printed("%+.*f to %+.*f", decimals, interval.low, decimals, interval.high)
             : "too few";
}

}  // namespace

Result<StudyComparison> compare_studies(const std::array<std::string, 2>& texts,
                                        const std::array<std::string, 2>& names) {
  const auto first = read_operations(texts[0], names[0]);
  if (!first) {
    return first.error();
  }
  const auto second = read_operations(texts[1], names[1]);
  if (!second) {
    return second.error();
  }
  StudyComparison out;
  const bool told_apart = first->method != second->method;
  out.first = told_apart ? first->method : names[0];
  out.second = told_apart ? second->method : names[1];
  count_operations(first->operations, second->operations, out);
  if (out.operations == 0) {
    return Error{names[0] + ", " + names[1] + ": no operation in common (the same case and seed)"};
  }
  for (const ReportQuantity& quantity : kCompared) {
    auto found = compared(quantity, first->operations, second->operations);
    if (found.pairs > 0) {
      out.quantities.push_back(std::move(found));
    }
  }
  return out;
}

double margin_of(const ReportQuantity& quantity) { return quantity.unit == "s" ? 5.0 : 0.5; }

std::string comparison_table(const StudyComparison& comparison) {
  const std::string& a = comparison.first;
  const std::string& b = comparison.second;
  std::string out = std::to_string(comparison.operations) +
                    " operations in both studies (only in `" + a +
                    "`: " + std::to_string(comparison.only_first) + ", only in `" + b +
                    "`: " + std::to_string(comparison.only_second) + "); completed: `" + a + "` " +
                    std::to_string(comparison.completed_first) + ", `" + b + "` " +
                    std::to_string(comparison.completed_second) +
                    ". Means over operations, pair by pair.\n\n| | `" + a + "` | `" + b + "` | `" +
                    a + "` less `" + b +
                    "` | 95 % interval | equivalent within | p | operations | pairs "
                    "|\n|---|---|---|---|---|---|---|---|---|\n";
  for (const ComparedQuantity& q : comparison.quantities) {
    out += "| " + std::string(q.quantity.name) + ", " + std::string(q.quantity.unit) +
           printed(" | %.2f | %.2f | %+.2f | ", q.first_mean, q.second_mean, q.difference.mean) +
           interval_text(q.difference, 2) +
           printed(" | %g | %.3f | ", margin_of(q.quantity), q.equivalent_p) +
           std::to_string(q.operations.size()) + " | " + std::to_string(q.pairs) +
           (q.quantity.per_screw ? " screws |\n" : " levels |\n");
  }
  return out;
}

nlohmann::ordered_json comparison_json(const StudyComparison& comparison) {
  using OrderedJson = nlohmann::ordered_json;
  OrderedJson out{{"first", comparison.first},
                  {"second", comparison.second},
                  {"operations", comparison.operations},
                  {"only_first", comparison.only_first},
                  {"only_second", comparison.only_second},
                  {"completed_first", comparison.completed_first},
                  {"completed_second", comparison.completed_second},
                  {"quantities", OrderedJson::array()}};
  for (const ComparedQuantity& q : comparison.quantities) {
    OrderedJson operations = OrderedJson::array();
    for (const PairedOperation& one : q.operations) {
      operations.push_back({{"case", one.case_name},
                            {"seed", one.seed},
                            {"first", one.first},
                            {"second", one.second}});
    }
    out["quantities"].push_back({{"name", q.quantity.name},
                                 {"unit", q.quantity.unit},
                                 {"pairs", q.pairs},
                                 {"first_mean", q.first_mean},
                                 {"second_mean", q.second_mean},
                                 {"difference", q.difference.mean},
                                 {"low_95", q.difference.low},
                                 {"high_95", q.difference.high},
                                 {"margin", margin_of(q.quantity)},
                                 {"equivalent_p", q.equivalent_p},
                                 {"operations", operations}});
  }
  return out;
}

}  // namespace orthonav::engine
