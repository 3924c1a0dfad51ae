#include "hal/hl2ss/server/faults.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "base/joined.h"

namespace orthonav::hl2ss {
namespace {

constexpr std::array<std::pair<std::string_view, double Faults::*>, 11> kProbabilities = {{
    {"gap", &Faults::gap},
    {"lose", &Faults::lose},
    {"unlocated", &Faults::unlocated},
    {"stall", &Faults::stall},
    {"half", &Faults::half},
    {"cut", &Faults::cut},
    {"misstamp", &Faults::misstamp},
    {"corrupt", &Faults::corrupt},
    {"scene_stall", &Faults::scene_stall},
    {"scene_refuse", &Faults::scene_refuse},
    {"scene_cut", &Faults::scene_cut},
}};
constexpr std::array<std::pair<std::string_view, std::optional<std::int64_t> Faults::*>, 7> kFrom =
    {{
        {"freeze_pictures", &Faults::freeze_pictures},
        {"freeze_left", &Faults::freeze_left},
        {"freeze_right", &Faults::freeze_right},
        {"freeze_poses", &Faults::freeze_poses},
        {"shift_right", &Faults::shift_right},
        {"only_left", &Faults::only_left},
        {"clock_back", &Faults::clock_back},
    }};
constexpr const char* kKnown =
    "known are gap, lose, unlocated, stall, half, cut, misstamp, corrupt, "
    "scene_stall, scene_refuse, scene_cut (probabilities), jump, freeze_pictures, freeze_left, "
    "freeze_right, freeze_poses, shift_right, only_left, clock_back, lasting (numbers of pairs), "
    "clock_back_s and all";
constexpr double kMaxPairs = 1e9;
constexpr double kLongestClockBack_s = 3600.0;
/// Probability of each fault if all are requested.
constexpr double kALittle = 0.01;

Status apply(std::string_view item, Faults& faults) {
  if (item == "all") {
    for (const auto& [name, member] : kProbabilities) {
      faults.*member = kALittle;
    }
    return {};
  }
  const std::size_t equals = std::min(item.find('='), item.size());
  const std::string_view key = item.substr(0, equals);
  const std::string_view value = item.substr(std::min(equals + 1, item.size()));
  double number = 0.0;
  const char* end = value.data() + value.size();
  const auto [rest, code] = std::from_chars(value.data(), end, number);
  const bool is_number = !value.empty() && code == std::errc{} && rest == end;
  if (is_number && number >= 0.0 && number <= kMaxPairs && number == std::floor(number)) {
    const auto pair = static_cast<std::int64_t>(number);
    if (key == "jump") {
      faults.jump_at.push_back(pair);
      return {};
    }
    if (key == "lasting") {
      faults.lasting = pair;
      return {};
    }
    for (const auto& [name, member] : kFrom) {
      if (key == name) {
        faults.*member = pair;
        return {};
      }
    }
  }
  if (key == "clock_back_s" && is_number && number > 0.0 && number <= kLongestClockBack_s) {
    faults.clock_back_by = from_seconds(number);
    return {};
  }
  for (const auto& [name, member] : kProbabilities) {
    if (key == name && is_number) {
      faults.*member = number;
      return {};
    }
  }
  return Error{"faults: \"" + std::string(item) + "\" is not understood; " + kKnown};
}

}  // namespace

std::vector<std::string> Faults::check() const {
  std::vector<std::string> problems;
  for (const auto& [name, member] : kProbabilities) {
    if (!(this->*member >= 0.0 && this->*member <= 1.0)) {
      problems.push_back(std::string(name) + " must lie in [0, 1]");
    }
  }
  return problems;
}

Result<Faults> faults_of(std::string_view text) {
  Faults faults;
  while (!text.empty()) {
    const std::size_t comma = text.find(',');
    if (const Status applied = apply(text.substr(0, comma), faults); !applied) {
      return applied.error();
    }
    text = comma == std::string_view::npos ? std::string_view{} : text.substr(comma + 1);
  }
  const auto problems = faults.check();
  if (!problems.empty()) {
    return Error{"faults: " + joined(problems)};
  }
  return faults;
}

}  // namespace orthonav::hl2ss
