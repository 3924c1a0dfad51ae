#include "tools/orthonav/calibrate/image_pairs.h"

#include <glob.h>

#include <cctype>
#include <filesystem>
#include <map>
#include <optional>

namespace orthonav::tools {
namespace {

/// "7" of "left07.jpg", "2-7" of "cam2_007.png".
std::string numbers_in(const std::string& path) {
  std::string numbers;
  bool in_number = false;
  for (const char c : std::filesystem::path(path).stem().string()) {
    const bool digit = std::isdigit(static_cast<unsigned char>(c)) != 0;
    if (digit && !in_number && !numbers.empty()) {
      numbers += '-';
    }
    const bool leading_zero = c == '0' && (numbers.empty() || numbers.back() == '-');
    if (digit && !leading_zero) {
      numbers += c;
    }
    in_number = digit;
  }
  return numbers;
}

/// By number; nothing if a number is missing or appears twice.
std::optional<std::map<std::string, std::string>> by_number(const std::vector<std::string>& names) {
  std::map<std::string, std::string> found;
  for (const std::string& name : names) {
    const std::string number = numbers_in(name);
    if (number.empty() || !found.emplace(number, name).second) {
      return std::nullopt;
    }
  }
  return found;
}

}  // namespace

Result<std::vector<std::string>> expanded(const std::vector<std::string>& names) {
  std::vector<std::string> files;
  for (const std::string& name : names) {
    if (name.find_first_of("*?") == std::string::npos || std::filesystem::exists(name)) {
      files.push_back(name);
      continue;
    }
    glob_t found{};
    // The command has one thread. NOLINTNEXTLINE(concurrency-mt-unsafe)
    const int status = glob(name.c_str(), 0, nullptr, &found);
    if (status == 0) {
      files.insert(files.end(), found.gl_pathv, found.gl_pathv + found.gl_pathc);
    }
    globfree(&found);
    if (status != 0) {
      return Error{name + ": no file matches"};
    }
  }
  return files;
}

Result<PairedImages> paired(const std::vector<std::string>& left,
                            const std::vector<std::string>& right) {
  PairedImages images;
  const auto left_numbers = by_number(left);
  const auto right_numbers = by_number(right);
  bool any = false;
  if (left_numbers && right_numbers) {
    for (const auto& [number, name] : *left_numbers) {
      any = any || right_numbers->count(number) > 0;
    }
  }
  if (any) {
    // In the order in which the left ones are given.
    for (const std::string& name : left) {
      const auto partner = right_numbers->find(numbers_in(name));
      if (partner == right_numbers->end()) {
        images.alone.push_back(name);
      } else {
        images.pairs.push_back({name, partner->second});
      }
    }
    for (const std::string& name : right) {
      if (left_numbers->count(numbers_in(name)) == 0) {
        images.alone.push_back(name);
      }
    }
    return images;
  }
  if (left.size() != right.size()) {
    return Error{std::to_string(left.size()) + " left and " + std::to_string(right.size()) +
                 " right images, whose names do not tell which belong together"};
  }
  for (std::size_t i = 0; i < left.size(); ++i) {
    images.pairs.push_back({left[i], right[i]});
  }
  return images;
}

}  // namespace orthonav::tools
