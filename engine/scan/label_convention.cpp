#include "engine/scan/label_convention.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

#include "base/joined.h"
#include "base/one_line.h"
#include "base/printed.h"
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

/// Runs of letters (of one case after its first, so that "vertebraL4" is three words) and of
/// digits.
std::vector<std::string> words_of_name(const std::string& name) {
  const auto kind = [](unsigned char c) {
    return std::isdigit(c) != 0               ? 'd'
           : std::isupper(c) != 0             ? 'u'
           : std::isalpha(c) != 0 || c >= 128 ? 'l'
                                              : ' ';
  };
  std::vector<std::string> words;
  char last = ' ';
  for (const char c : name) {
    const char now = kind(static_cast<unsigned char>(c));
    const bool goes_on = now == last || (now == 'l' && last == 'u');
    if (now != ' ') {
      if (!goes_on) {
        words.emplace_back();
      }
      words.back() += c;
    }
    last = now;
  }
  for (std::string& word : words) {
    word = lower_case(word);
  }
  return words;
}

/// The index N of each `SegmentN_...` field, in ascending order.
std::set<int> segments_of(const Volume& labels) {
  std::set<int> out;
  for (const auto& [key, value] : labels.fields) {
    const std::size_t end = key.find('_');
    if (key.starts_with("Segment") && end != std::string::npos &&
        (key.ends_with("_ID") || key.ends_with("_Name"))) {
      if (const auto index = number_from(key.substr(7, end - 7)); index && *index < 1e5) {
        out.insert(static_cast<int>(*index));
      }
    }
  }
  return out;
}

/// The layer of a segment: as stated, or that of its own index.
Result<std::size_t> layer_of(const Volume& labels, int index) {
  const std::string segment = "Segment" + std::to_string(index);
  const std::string stated = field_of(labels, segment + "_Layer");
  if (stated.empty() && labels.layers == 1 && !field_of(labels, segment + "_LabelValue").empty()) {
    return std::size_t{0};
  }
  const auto layer = stated.empty() ? std::optional<double>(index) : number_from(stated);
  if (!layer || !(*layer >= 0.0 && *layer < static_cast<double>(labels.layers))) {
    return Error{segment +
                 (stated.empty() ? " states no layer, and none has its index: the file has "
                                 : "_Layer is outside of the file's ") +
                 std::to_string(labels.layers) + (labels.layers == 1 ? " layer" : " layers")};
  }
  return static_cast<std::size_t>(*layer);
}

/// The segments of a 3D Slicer file whose names are a vertebra's.
Result<LabelledLevels> named_levels(const Volume& labels) {
  std::vector<std::set<float>> present;
  for (std::size_t layer = 0; layer < labels.layers; ++layer) {
    present.push_back(values_in(labels, layer));
  }
  LabelledLevels out;
  std::vector<std::string> others;
  for (const int index : segments_of(labels)) {
    const std::string segment = "Segment" + std::to_string(index);
    const std::string name = field_of(labels, segment + "_Name");
    const auto level = vertebra_named(name);
    if (!level) {
      others.push_back("\"" + one_line(name.empty() ? segment : name) + "\"");
      continue;
    }
    const auto layer = layer_of(labels, index);
    if (!layer) {
      return layer.error();
    }
    const double value = number_from(field_of(labels, segment + "_LabelValue")).value_or(1.0);
    if (!present[*layer].contains(static_cast<float>(value))) {
      continue;  // an empty segment
    }
    if (std::any_of(out.levels.begin(), out.levels.end(),
                    [&](const LabelledLevel& other) { return other.label == *level; })) {
      return Error{"two segments are named " + *level};
    }
    out.levels.push_back({*level, *layer, static_cast<int>(value)});
  }
  if (!others.empty()) {
    out.left_out.push_back("segments that are no vertebra by their name: " + joined(others, ", "));
  }
  if (out.levels.empty()) {
    return Error{"no segment is named after a vertebra, such as \"L4\"" +
                 (others.empty() ? "" : " (there are: " + joined(others, ", ") + ")")};
  }
  sort_from_the_head(out.levels);
  return out;
}

/// Whether a convention has a meaning for the number at all: VerSe ends at 28 and its extensions
/// (TPTBox: parts of vertebrae, cord, discs) begin at 40; TotalSegmentator counts its organs.
bool means_something(int label, const std::string& convention) {
  if (convention == "verse") {
    return label <= 28 || label >= 40;
  }
  return label <= (convention == "totalsegmentator" ? 117 : 104);
}

}  // namespace

const std::vector<std::string>& label_conventions() {
  static const std::vector<std::string> names = {"verse", "totalsegmentator",
                                                 "totalsegmentator-v1"};
  return names;
}

std::optional<std::string> vertebra_named(const std::string& name) {
  // The letter of a region that a number follows, and words that say it is a vertebra.
  static const std::map<std::string, char> kRegions = {
      {"c", 'C'},          {"hwk", 'C'},         {"cervical", 'C'},
      {"halswirbel", 'C'}, {"t", 'T'},           {"th", 'T'},
      {"d", 'T'},          {"bwk", 'T'},         {"thoracic", 'T'},
      {"dorsal", 'T'},     {"brustwirbel", 'T'}, {"l", 'L'},
      {"lwk", 'L'},        {"lumbar", 'L'},      {"lendenwirbel", 'L'},
      {"s", 'S'},          {"swk", 'S'},         {"sacral", 'S'}};
  static const std::set<std::string> kSayNothing = {
      "vertebra", "vertebrae",    "vertebral", "vert",    "body",        "bone",
      "wirbel",   "wirbelkörper", "level",     "segment", "label",       "mask",
      "of",       "the",          "whole",     "seg",     "segmentation"};
  std::optional<std::string> found;
  char region = 0;
  for (const std::string& word : words_of_name(name)) {
    if (const auto known = kRegions.find(word); known != kRegions.end()) {
      region = known->second;
    } else if (std::isdigit(static_cast<unsigned char>(word[0])) != 0) {
      const std::string level =
          std::string(1, region) + std::to_string(word.size() <= 2 ? std::stoi(word) : 99);
      if (region == 0 || !place_in_spine(level) || (found && *found != level)) {
        return std::nullopt;
      }
      found = level;
    } else if (!kSayNothing.contains(word)) {
      return std::nullopt;
    }
  }
  return found;
}

Result<LabelledLevels> labelled_levels(const Volume& labels, const std::string& convention) {
  if (convention.empty() && !segments_of(labels).empty()) {
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
  LabelledLevels out;
  std::vector<std::string> others;
  for (const float value : values_in(labels, 0)) {
    if (!(value > 0.0F && value <= 65535.0F && std::floor(value) == value)) {
      return Error{printed("holds %g, labels are whole numbers from 0 to 65535", double{value})};
    }
    const int label = static_cast<int>(value);
    if (!means_something(label, convention)) {
      return Error{"holds " + std::to_string(label) + ", which " + convention + " does not define" +
                   ": is it another convention?"};
    }
    const auto found = names.find(label);
    if (found != names.end()) {
      out.levels.push_back({found->second, 0, label});
    } else {
      others.push_back(std::to_string(label));
    }
  }
  const auto has = [&](const char* level) {
    return std::any_of(out.levels.begin(), out.levels.end(),
                       [&](const LabelledLevel& each) { return each.label == level; });
  };
  if (has("T13") && !has("T12") && !has("L1")) {
    return Error{
        "holds a T13 (28) without T12 or L1: is it another convention? 28 is L4 of "
        "totalsegmentator"};
  }
  if (out.levels.empty()) {
    return Error{"holds no vertebra of the convention " + convention +
                 (others.empty() ? "" : " (it has: " + joined(others, ", ") + ")")};
  }
  if (!others.empty()) {
    out.left_out.push_back("labels that are no vertebrae: " + joined(others, ", "));
  }
  sort_from_the_head(out.levels);
  return out;
}

}  // namespace orthonav::engine
