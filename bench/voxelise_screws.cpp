// Writes a post-operative scan computed from a case, and the truth beside it, for trying out
// `orthonav evaluate`. It shares no code with the search for screws.
#include <algorithm>
#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/case/case_file.h"
#include "tests/support/nrrd_scan.h"
#include "tests/support/operated_spine.h"
#include "tests/support/voxelised_scan.h"

namespace {

using namespace orthonav;

nlohmann::json in_mm(Vec3 v) { return {v.x * 1e3, v.y * 1e3, v.z * 1e3}; }

nlohmann::json truth_of(const engine::Case& subject, const test::OperatedSpine& spine) {
  nlohmann::json out;
  for (const test::TrueScrew& screw : spine.screws) {
    const engine::CaseLevel& level = subject.levels[screw.level];
    out["screws"].push_back({{"level", level.label},
                             {"side", name_of(level.screws[screw.screw].side)},
                             {"placed", screw.placed},
                             {"entry_mm", in_mm(screw.entry_m)},
                             {"tip_mm", in_mm(screw.tip_m)},
                             {"diameter_mm", 2e3 * screw.radius_m}});
  }
  return out;
}

/// The case with these levels alone; without labels, all.
Result<engine::Case> case_of(const std::string& folder, const std::vector<std::string>& labels) {
  auto subject = engine::load_case(folder);
  if (subject && !labels.empty()) {
    std::erase_if(subject->levels, [&](const engine::CaseLevel& level) {
      return std::find(labels.begin(), labels.end(), level.label) == labels.end();
    });
    if (subject->levels.empty()) {
      return Error{folder + ": has none of these levels"};
    }
  }
  return subject;
}

}  // namespace

int main(int argc, char** argv) {
  std::string folder;
  std::string out;
  std::vector<std::string> labels;
  std::uint64_t seed = 1;
  double slice_mm = 0.6;
  double bow_mm = 0.0;
  test::OperationSettings settings;
  test::ScannerSettings scanner;
  CLI::App app("A post-operative CT of a case, computed: OUT.nrrd, and the truth in OUT.json");
  app.add_option("--case", folder, "case with plans")->required();
  app.add_option("--levels", labels, "default: all")->delimiter(',');
  app.add_option("--out", out, "without ending")->required();
  app.add_option("--seed", seed);
  app.add_option("--slice-mm", slice_mm);
  app.add_option("--noise-hu", scanner.noise_hu);
  app.add_option("--streaks", scanner.streaks, "0: none");
  app.add_option("--missing", settings.missing, "share of planned screws that are left out");
  app.add_option("--bow-mm", bow_mm, "of wires");
  app.add_flag("--wires", settings.wires);
  app.add_flag("--rods", settings.rods);
  CLI11_PARSE(app, argc, argv);
  const auto subject = case_of(folder, labels);
  if (!subject) {
    std::fprintf(stderr, "%s\n", subject.error().message.c_str());
    return 2;
  }
  settings.bow_m = bow_mm * 1e-3;
  const auto spine = test::operated(*subject, settings, Random(seed));
  test::BodySettings body;
  body.seed = seed;
  scanner.seed = seed;
  scanner.spacing_m.z = slice_mm * 1e-3;
  const engine::Volume scan =
      test::scanned(test::fine_body(spine.bones, spine.metal, body), scanner);
  std::ofstream truth(out + ".json");
  truth << truth_of(*subject, spine).dump(1) << "\n";
  return test::write_nrrd(out + ".nrrd", scan) && truth.good() ? 0 : 1;
}
