#include "tests/house/rules.h"

#include <algorithm>
#include <array>
#include <regex>

namespace orthonav::house {
namespace {

constexpr int kMostLines = 300;

bool starts_with_any(const std::string& text, const std::vector<std::string>& beginnings) {
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [&](const std::string& beginning) { return text.starts_with(beginning); });
}

/// Which of our own folders the files of a folder may include; the longest match counts.
struct Allowed {
  std::string folder;
  std::vector<std::string> includes;
};

const std::vector<Allowed>& dependency_rule() {
  static const std::vector<Allowed> kRule = {
      {"hal/api/", {"hal/api/"}},
      {"hal/open/", {"hal/"}},
      {"hal/sim/", {"hal/api/", "hal/sim/"}},
      {"hal/replay/", {"hal/api/", "hal/replay/"}},
      {"hal/fake/", {"hal/api/", "hal/fake/"}},
      {"nav/", {"nav/", "hal/api/"}},
      {"render/", {"render/"}},
      {"engine/", {"engine/", "render/", "nav/", "hal/"}},
      {"tools/", {"tools/", "engine/", "render/", "nav/", "hal/"}},
  };
  return kRule;
}

struct Include {
  std::string name;
  bool ours = false;  ///< in quotes
};

std::vector<Include> includes_of(const std::string& text) {
  static const std::regex kInclude("(?:^|\\n)[ \\t]*#[ \\t]*include[ \\t]*([\"<])([^\">]+)[\">]");
  std::vector<Include> found;
  for (std::sregex_iterator i(text.begin(), text.end(), kInclude), end; i != end; ++i)
    found.push_back({(*i)[2].str(), (*i)[1].str() == "\""});
  return found;
}

void check_dependency(const std::string& path, const Include& include,
                      std::vector<std::string>& broken) {
  if (!include.ours || include.name.starts_with("embedded/")) return;
  for (const Allowed& rule : dependency_rule()) {
    if (!path.starts_with(rule.folder)) continue;
    if (!starts_with_any(include.name, rule.includes))
      broken.push_back(path + ": " + rule.folder + " must not include " + include.name);
    return;
  }
}

/// The simulator's truth is for the evaluation after the fact alone.
void check_truth(const std::string& path, const Include& include,
                 std::vector<std::string>& broken) {
  const bool may = path.starts_with("hal/sim/") || path.starts_with("engine/evaluation");
  if (include.name == "hal/sim/truth.h" && !may)
    broken.push_back(path + ": only hal/sim and engine/evaluation may know the truth");
}

void check_heavy(const std::string& path, const Include& include,
                 std::vector<std::string>& broken) {
  const bool vulkan = starts_with_any(include.name, {"vulkan/", "glm/"});
  const bool vision = starts_with_any(include.name, {"opencv2/", "apriltag/", "apriltag.h"});
  const bool heavy = starts_with_any(
      include.name, {"Eigen/", "assimp/", "archive", "nlohmann/json.hpp", "libav", "spdlog/"});
  const bool header = path.ends_with(".h");
  if (vulkan && !path.starts_with("render/"))
    broken.push_back(path + ": " + include.name + " belongs to render alone");
  if (header && path.starts_with("nav/") && (vision || heavy))
    broken.push_back(path + ": a header of nav must not include " + include.name);
  if (header && path.starts_with("engine/") && (vision || heavy))
    broken.push_back(path + ": a header of engine must not include " + include.name);
}

}  // namespace

std::vector<std::string> broken_rules(const std::string& path, const std::string& text) {
  std::vector<std::string> broken;
  for (const Include& include : includes_of(text)) {
    check_dependency(path, include, broken);
    check_truth(path, include, broken);
    check_heavy(path, include, broken);
  }
  const auto lines = std::count(text.begin(), text.end(), '\n');
  if (lines > kMostLines)
    broken.push_back(path + ": " + std::to_string(lines) + " lines, limit " +
                     std::to_string(kMostLines));
  return broken;
}

}  // namespace orthonav::house
