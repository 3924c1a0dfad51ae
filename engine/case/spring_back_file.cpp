#include "engine/case/spring_back_file.h"

#include <cstddef>

#include "base/angle.h"
#include "base/printed.h"
#include "engine/io/json_document.h"
#include "engine/io/text_fields.h"

namespace orthonav::engine {
namespace {

constexpr std::size_t kMaxTrials = 1000;

}  // namespace

Result<std::vector<nav::SpringBackTrial>> load_spring_back(const std::string& path) {
  const auto text = read_text(path);
  if (!text) {
    return text.error();
  }
  std::vector<nav::SpringBackTrial> trials;
  bool header = false;
  bool set_first = true;
  std::size_t number = 0;
  for (const std::string& line : lines_of(*text)) {
    ++number;
    if (line.empty() || line.starts_with('#')) {
      continue;
    }
    const auto fields = split(line, ',');
    if (!header) {
      set_first = fields == std::vector<std::string>{"set_deg", "kept_deg"};
      if (!set_first && fields != std::vector<std::string>{"kept_deg", "set_deg"}) {
        return Error{
            printed("%s: line %zu must be the header set_deg,kept_deg", path.c_str(), number)};
      }
      header = true;
      continue;
    }
    const auto first = fields.size() == 2 ? number_from(fields[0]) : std::nullopt;
    const auto second = fields.size() == 2 ? number_from(fields[1]) : std::nullopt;
    if (!first || !second) {
      return Error{printed("%s: line %zu must hold two numbers", path.c_str(), number)};
    }
    if (trials.size() == kMaxTrials) {
      return Error{printed("%s: more than %zu trials", path.c_str(), kMaxTrials)};
    }
    trials.push_back({(set_first ? *first : *second) * kRadiansPerDegree,
                      (set_first ? *second : *first) * kRadiansPerDegree});
  }
  if (trials.empty()) {
    return Error{path + ": holds no trials"};
  }
  return trials;
}

}  // namespace orthonav::engine
