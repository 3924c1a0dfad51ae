#include "engine/case/screw_sizes_file.h"

#include <algorithm>

#include "base/joined.h"
#include "base/printed.h"
#include "base/units.h"
#include "engine/io/json_document.h"

namespace orthonav::engine {
namespace {

constexpr std::size_t kMaxLengths = 100;

ScrewSize size_from(const JsonNode& node) {
  ScrewSize size;
  size.diameter_m = node.number("diameter_mm") * kMetresPerMm;
  for (const double length_mm : node.number_list("lengths_mm", kMaxLengths)) {
    size.lengths_m.push_back(length_mm * kMetresPerMm);
  }
  if (node.has("head_to_seat_mm")) {
    size.head_to_seat_m = node.number("head_to_seat_mm") * kMetresPerMm;
  }
  std::sort(size.lengths_m.begin(), size.lengths_m.end());
  const auto twice = std::adjacent_find(size.lengths_m.begin(), size.lengths_m.end());
  if (twice != size.lengths_m.end()) {
    node.refuse("lengths_mm", printed("holds %g twice", *twice / kMetresPerMm));
  }
  return size;
}

}  // namespace

Result<ScrewSizes> load_screw_sizes(const std::string& path) {
  const Result<JsonDocument> document = JsonDocument::read(path);
  if (!document) {
    return document.error();
  }
  ScrewSizes sizes;
  for (const JsonNode& node : document->root().list("screws")) {
    sizes.by_diameter.push_back(size_from(node));
    const double diameter_m = sizes.by_diameter.back().diameter_m;
    for (std::size_t i = 0; i + 1 < sizes.by_diameter.size(); ++i) {
      if (sizes.by_diameter[i].diameter_m == diameter_m) {
        node.refuse("diameter_mm", printed("is %g, given twice", diameter_m / kMetresPerMm));
      }
    }
  }
  if (const Status status = document->status(); !status) {
    return status.error();
  }
  std::sort(sizes.by_diameter.begin(), sizes.by_diameter.end(),
            [](const ScrewSize& a, const ScrewSize& b) { return a.diameter_m < b.diameter_m; });
  if (const auto problems = sizes.check(); !problems.empty()) {
    return Error{path + ": " + joined(problems)};
  }
  return sizes;
}

}  // namespace orthonav::engine
