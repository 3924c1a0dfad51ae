#include "engine/scan/label_convention.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/joined.h"
#include "engine/case/line_name.h"
#include "engine/io/text_fields.h"
#include "engine/scan/level_places.h"

namespace orthonav::engine {
namespace {

/// Numbers that run down the spine in steps of `step`, L1 being `l1`; `s1` 0: no S1.
std::map<int, std::string> counted(int l1, int step, int lumbar, int s1) {
  std::map<int, std::string> out;
  for (int i = 0; i < 7; ++i) {
    out[l1 - step * (19 - i)] = "C" + std::to_string(i + 1);
  }
  for (int i = 0; i < 12; ++i) {
    out[l1 - step * (12 - i)] = "T" + std::to_string(i + 1);
  }
  for (int i = 0; i < lumbar; ++i) {
    out[l1 + step * i] = "L" + std::to_string(i + 1);
  }
  if (s1 != 0) {
    out[s1] = "S1";
  }
  return out;
}

std::map<int, std::string> names_of(const std::string& convention) {
  if (convention == "verse") {
    auto names = counted(20, 1, 6, 26);
    names[28] = "T13";
    return names;
  }
  if (convention == "totalsegmentator") {
    return counted(31, -1, 5, 26);
  }
  if (convention == "totalsegmentator-v1") {
    return counted(22, -1, 5, 0);
  }
  return {};
}

/// The values in a layer other than 0, as they are.
std::set<float> values_in(const Volume& labels, std::size_t layer) {
  std::set<float> values;
  float last = 0.0F;
  for (std::size_t i = layer; i < labels.values.size(); i += labels.layers) {
    if (labels.values[i] != last) {
      last = labels.values[i];
      values.insert(last);
    }
  }
  values.erase(0.0F);
  return values;
}

void sort_from_the_head(std::vector<LabelledLevel>& levels) {
  std::stable_sort(levels.begin(), levels.end(),
                   [](const LabelledLevel& a, const LabelledLevel& b) {
                     return place_in_spine(a.label) < place_in_spine(b.label);
                   });
}

std::string field_of(const Volume& labels, const std::string& key) {
  const auto found = labels.fields.find(key);
  return found == labels.fields.end() ? std::string() : found->second;
}

/// The segments of a 3D Slicer file whose names contain a level.
Result<std::vector<LabelledLevel>> named_levels(const Volume& labels) {
  constexpr int kMostSegments = 1000;
  std::vector<std::set<float>> present;
  for (std::size_t layer = 0; layer < labels.layers; ++layer) {
    present.push_back(values_in(labels, layer));
  }
  std::vector<LabelledLevel> levels;
  for (int i = 0; i < kMostSegments; ++i) {
    const std::string segment = "Segment" + std::to_string(i);
    const std::string name = field_of(labels, segment + "_Name");
    if (name.empty()) {
      break;
    }
    const std::string level = parsed_line_name(name).level;
    if (!place_in_spine(level)) {
      continue;
    }
    const double layer = number_from(field_of(labels, segment + "_Layer")).value_or(0.0);
    const double value = number_from(field_of(labels, segment + "_LabelValue")).value_or(1.0);
    if (!(layer >= 0.0 && layer < static_cast<double>(labels.layers))) {
      return Error{segment + "_Layer is outside of the file's " + std::to_string(labels.layers) +
                   " layers"};
    }
    const auto at = static_cast<std::size_t>(layer);
    if (!present[at].contains(static_cast<float>(value))) {
      continue;  // an empty segment
    }
    if (std::any_of(levels.begin(), levels.end(),
                    [&](const LabelledLevel& other) { return other.label == level; })) {
      return Error{"two segments are named " + level};
    }
    levels.push_back({level, at, static_cast<int>(value)});
  }
  if (levels.empty()) {
    return Error{"no segment is named after a vertebra, such as \"L4\""};
  }
  sort_from_the_head(levels);
  return levels;
}

}  // namespace

const std::vector<std::string>& label_conventions() {
  static const std::vector<std::string> names = {"verse", "totalsegmentator",
                                                 "totalsegmentator-v1"};
  return names;
}

Result<std::vector<LabelledLevel>> labelled_levels(const Volume& labels,
                                                   const std::string& convention) {
  if (convention.empty() && labels.fields.contains("Segment0_Name")) {
    return named_levels(labels);
  }
  const auto names = names_of(convention);
  if (names.empty()) {
    return Error{(convention.empty() ? std::string("its numbers mean nothing without a convention")
                                     : "unknown convention \"" + convention + "\"") +
                 "; state one with --convention: " + joined(label_conventions(), ", ")};
  }
  if (labels.layers != 1) {
    return Error{"has " + std::to_string(labels.layers) + " values a voxel, a label map has 1"};
  }
  std::vector<LabelledLevel> levels;
  for (const float value : values_in(labels, 0)) {
    if (!(value > 0.0F && value <= 65535.0F && std::floor(value) == value)) {
      return Error{"holds " + std::to_string(value) + ", labels are whole numbers from 0 to 65535"};
    }
    const auto found = names.find(static_cast<int>(value));
    if (found != names.end()) {
      levels.push_back({found->second, 0, static_cast<int>(value)});
    }
  }
  if (levels.empty()) {
    return Error{"holds no vertebra of the convention " + convention};
  }
  sort_from_the_head(levels);
  return levels;
}

}  // namespace orthonav::engine
