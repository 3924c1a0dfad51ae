// Writes a post-operative scan that is computed from a case, and the truth beside it: for orthonav
// evaluate, and for whoever wants to look. It shares nothing with what finds the screws.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/case/case_file.h"
#include "tests/support/operated_spine.h"
#include "tests/support/voxelised_scan.h"

namespace {

using namespace orthonav;

nlohmann::json in_mm(Vec3 v) { return {v.x * 1e3, v.y * 1e3, v.z * 1e3}; }

bool write_nrrd(const std::string& path, const engine::Volume& scan) {
  std::ofstream file(path, std::ios::binary);
  const auto& grid = scan.grid;
  const Vec3 s = grid.spacing_m * 1e3;
  const Vec3 o = grid.origin_m * 1e3;
  char head[512];
  std::snprintf(head, sizeof head,
                "NRRD0004\ntype: int16\ndimension: 3\nsizes: %d %d %d\nencoding: raw\nendian: "
                "little\nspace: left-posterior-superior\nspace directions: (%.9f,0,0) (0,%.9f,0) "
                "(0,0,%.9f)\nspace origin: (%.9f,%.9f,%.9f)\n\n",
                grid.size[0], grid.size[1], grid.size[2], s.x, s.y, s.z, o.x, o.y, o.z);
  file << head;
  std::vector<std::int16_t> values(scan.values.begin(), scan.values.end());
  file.write(reinterpret_cast<const char*>(values.data()),
             static_cast<std::streamsize>(2 * values.size()));
  return file.good();
}

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
  auto loaded = engine::load_case(folder);
  if (!loaded) {
    std::fprintf(stderr, "%s\n", loaded.error().message.c_str());
    return 2;
  }
  engine::Case& subject = *loaded;
  if (!labels.empty()) {
    std::erase_if(subject.levels, [&](const engine::CaseLevel& level) {
      return std::find(labels.begin(), labels.end(), level.label) == labels.end();
    });
  }
  std::vector<test::PlannedVertebra> vertebrae;
  for (const engine::CaseLevel& level : subject.levels) {
    vertebrae.push_back(
        {level.label,
         level.mesh,
         level.screws,
         {level.spine_from_vertebra.rotation(), level.spine_from_vertebra.translation()}});
  }
  settings.bow_m = bow_mm * 1e-3;
  const auto spine = test::operated(vertebrae, settings, Random(seed));
  test::BodySettings body;
  body.seed = seed;
  scanner.seed = seed;
  scanner.spacing_m.z = slice_mm * 1e-3;
  const engine::Volume scan =
      test::scanned(test::fine_body(spine.bones, spine.metal, body), scanner);
  std::ofstream truth(out + ".json");
  truth << truth_of(subject, spine).dump(1) << "\n";
  return write_nrrd(out + ".nrrd", scan) && truth.good() ? 0 : 1;
}
