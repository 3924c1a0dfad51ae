#include "tools/orthonav/shared/number_list.h"

#include <charconv>
#include <optional>
#include <set>

#include "engine/io/text_fields.h"

namespace orthonav::tools {
namespace {

std::optional<int> whole(const std::string& text) {
  int value = 0;
  const char* end = text.data() + text.size();
  const auto [rest, code] = std::from_chars(text.data(), end, value);
  if (text.empty() || code != std::errc() || rest != end || value < 0) {
    return std::nullopt;
  }
  return value;
}

}  // namespace

Result<std::vector<int>> number_list(const std::string& text, std::size_t most) {
  std::vector<int> numbers;
  std::set<int> seen;
  for (const std::string& field : engine::split(text, ',')) {
    const std::size_t dash = field.find('-');
    const auto first = whole(field.substr(0, dash));
    const auto last = dash == std::string::npos ? first : whole(field.substr(dash + 1));
    if (!first || !last || *last < *first) {
      return Error{"\"" + field + "\" must be a whole number or a range such as 0-5"};
    }
    for (std::int64_t number = *first; number <= *last; ++number) {
      if (numbers.size() == most) {
        return Error{"\"" + text + "\" holds more than " + std::to_string(most) + " numbers"};
      }
      if (!seen.insert(static_cast<int>(number)).second) {
        return Error{"\"" + text + "\" holds " + std::to_string(number) + " twice"};
      }
      numbers.push_back(static_cast<int>(number));
    }
  }
  return numbers;
}

}  // namespace orthonav::tools
