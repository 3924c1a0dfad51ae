#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/joined.h"
#include "base/length_text.h"
#include "engine/case/case_writer.h"
#include "engine/scan/label_convention.h"
#include "engine/scan/scan_case.h"
#include "engine/scan/volume_file.h"
#include "tools/orthonav/case/case_meshes.h"
#include "tools/orthonav/command.h"
#include "tools/orthonav/shared/arguments.h"
#include "tools/orthonav/shared/case_source.h"
#include "tools/orthonav/shared/json_output.h"
#include "tools/orthonav/shared/out_folder.h"
#include "tools/orthonav/shared/print_text.h"

namespace orthonav::tools {
namespace {

namespace fs = std::filesystem;
// Those for meshes (tools/orthonav/case/case_meshes.h), beside those for scans below.
using tools::levels_json;
using tools::print;

struct CaseArguments {
  std::string volume;
  std::string series;
  std::string labels;
  std::string convention;
  std::optional<double> threshold_hu;
  CaseMeshes meshes;
  std::vector<std::string> levels;
  std::string name;
  std::string out;
  bool list = false;
  bool unusual = false;
  JsonOutput json;
};

Error in_file(const std::string& path, const Error& error) {
  return {path + ": " + error.message, error.code};
}

Result<engine::ScanLevels> levels_of_labels(const CaseArguments& arguments) {
  const auto labels = load_scan(arguments.labels);
  if (!labels) {
    return labels.error();
  }
  if (!arguments.volume.empty()) {
    const auto scan = load_scan(arguments.volume, arguments.series);
    if (!scan) {
      return scan.error();
    }
    if (Status s = engine::check_on_bone(*labels, arguments.convention, *scan); !s) {
      return in_file(arguments.labels, s.error());
    }
  }
  auto made =
      engine::scan_levels(*labels, arguments.convention, arguments.levels, arguments.unusual);
  return made ? std::move(made)
              : Result<engine::ScanLevels>(in_file(arguments.labels, made.error()));
}

Result<engine::ScanLevels> levels_of_threshold(const CaseArguments& arguments) {
  const auto scan = load_scan(arguments.volume, arguments.series);
  if (!scan) {
    return scan.error();
  }
  auto made = engine::threshold_levels(*scan, *arguments.threshold_hu);
  return made ? std::move(made)
              : Result<engine::ScanLevels>(in_file(arguments.volume, made.error()));
}

/// Refuses arguments that do not go together.
Status check(const CaseArguments& arguments) {
  const bool labels = !arguments.labels.empty();
  const bool meshes = arguments.meshes.any();
  if (int{labels} + int{meshes} + int{arguments.threshold_hu.has_value()} != 1) {
    return Error{
        "vertebrae need --labels FILE (a segmentation) or --mesh LEVEL=FILE (for each); "
        "--threshold HU takes connected bone from --volume, where adjoining vertebrae are "
        "connected "
        "together as one part"};
  }
  if (arguments.threshold_hu && arguments.volume.empty()) {
    return Error{"--threshold needs --volume"};
  }
  if (!labels && !arguments.levels.empty()) {
    return Error{
        "--levels needs --labels: parts of a threshold have no names, meshes are named one by "
        "one"};
  }
  return {};
}

nlohmann::ordered_json levels_json(const engine::ScanLevels& made) {
  nlohmann::ordered_json out = {{"levels", nlohmann::ordered_json::array()},
                                {"left_out", made.left_out}};
  for (const engine::ScanLevel& level : made.levels) {
    const engine::SurfaceDeviation& d = level.surface.deviation;
    out["levels"].push_back({{"label", level.label},
                             {"voxels", level.voxels},
                             {"dropped_voxels", level.dropped},
                             {"canal", level.canal},
                             {"triangles", level.surface.mesh.triangles.size()},
                             {"deviation_median_mm", d.median_m * 1e3},
                             {"deviation_p95_mm", d.p95_m * 1e3},
                             {"deviation_max_mm", d.max_m * 1e3}});
  }
  return out;
}

void print(const engine::ScanLevels& made) {
  for (const engine::ScanLevel& level : made.levels) {
    const engine::SurfaceDeviation& d = level.surface.deviation;
    print_text("%s: %zu triangles; from the label's surface %s (median), %s (95 %%), %s (most)",
               level.label.c_str(), level.surface.mesh.triangles.size(),
               in_mm(d.median_m, 2).c_str(), in_mm(d.p95_m, 2).c_str(), in_mm(d.max_m, 2).c_str());
    if (level.dropped > 0) {
      print_text("; %zu of %zu voxels dropped, they are not connected with the rest", level.dropped,
                 level.voxels);
    }
    print_text("\n");
  }
}

void warn_of_no_canal(const std::string& label) {
  std::fprintf(stderr,
               "orthonav: warning: %s: no vertebral canal found; is it half a vertebra, or are the "
               "axes not the patient's?\n",
               label.c_str());
}

void warn(const engine::ScanLevels& made) {
  for (const std::string& line : made.left_out) {
    std::fprintf(stderr, "orthonav: left out: %s\n", line.c_str());
  }
  for (const engine::ScanLevel& level : made.levels) {
    if (!level.canal) {
      warn_of_no_canal(level.label);
    }
  }
}

void warn(const std::vector<engine::MeshLevel>& made) {
  for (const engine::MeshLevel& each : made) {
    if (!each.canal) {
      warn_of_no_canal(each.level.label);
    }
  }
}

/// The name from `--name`, or else that of the folder, however its path is written.
std::string case_name(const CaseArguments& arguments) {
  if (!arguments.name.empty()) {
    return arguments.name;
  }
  std::error_code code;
  const fs::path folder = fs::absolute(arguments.out, code) / "";
  return folder.lexically_normal().parent_path().filename().string();
}

/// Prints the series in a folder of DICOM, one below the other.
int run_list(const CaseArguments& arguments) {
  const auto series = engine::list_series(arguments.volume);
  if (!series) {
    return bad_input(series.error().message);
  }
  nlohmann::ordered_json json = {{"series", nlohmann::ordered_json::array()}};
  for (const engine::SeriesSummary& each : *series) {
    const auto mm = [&](std::size_t axis) { return each.spacing_m[axis] * 1e3; };
    json["series"].push_back({{"uid", each.uid},
                              {"description", each.description},
                              {"modality", each.modality},
                              {"slices", each.slices},
                              {"columns", each.size[0]},
                              {"rows", each.size[1]},
                              {"spacing_mm", {mm(0), mm(1), mm(2)}},
                              {"tilt_deg", each.tilt_deg},
                              {"problem", each.problem}});
    if (arguments.json.on_stdout()) {
      continue;
    }
    print_text("%s\n  %s, %d slices of %d x %d", each.uid.c_str(),
               each.modality.empty() ? "no modality" : each.modality.c_str(), each.slices,
               each.size[0], each.size[1]);
    print_text(", voxels %.2f x %.2f x %.2f mm, tilt %.1f°", mm(0), mm(1), mm(2), each.tilt_deg);
    print_text("%s%s%s\n", each.description.empty() ? "" : ", \"", each.description.c_str(),
               each.description.empty() ? "" : "\"");
    if (!each.problem.empty()) {
      print_text("  cannot be read: %s\n", each.problem.c_str());
    }
  }
  const Status written = arguments.json.write(json);
  return written ? kDone : bad_input(written.error().message);
}

/// Writes the case of the levels that were made, and what is to be known about them.
template <class Levels>
int save(const CaseArguments& arguments, const Result<Levels>& made, const std::string& unusual) {
  if (!made) {
    return bad_input(made.error().message);
  }
  const auto folder = OutFolder::create("--out", arguments.out);
  if (!folder) {
    return bad_input(folder.error().message);
  }
  engine::Case subject = case_of(*made, case_name(arguments));
  subject.unusual = unusual;
  const Status saved = engine::save_case(arguments.out, subject);
  if (const Status s = saved ? arguments.json.write(levels_json(*made)) : saved; !s) {
    return bad_input(s.error().message);
  }
  warn(*made);
  if (!unusual.empty()) {
    std::fprintf(stderr, "orthonav: warning: unusual spine: %s (noted in case.json)\n",
                 unusual.c_str());
  }
  if (arguments.threshold_hu) {
    std::fprintf(
        stderr,
        "orthonav: parts of a threshold: adjoining vertebrae are connected into one part; for "
        "single vertebrae use --labels\n");
  }
  if (!arguments.json.on_stdout()) {
    print(*made);
  }
  return kDone;
}

int run_make(const CaseArguments& arguments) {
  if (Status s = arguments.json.check(); !s) {
    return bad_input(s.error().message);
  }
  if (arguments.list) {
    return arguments.volume.empty() ? bad_input("--list needs --volume DICOM-FOLDER")
                                    : run_list(arguments);
  }
  if (arguments.out.empty()) {
    return bad_input("--out is required");
  }
  if (Status s = check(arguments); !s) {
    return bad_input(s.error().message);
  }
  std::error_code code;
  if (fs::exists(fs::path(arguments.out) / "case.json", code)) {
    return bad_input(arguments.out + "/case.json: already exists");
  }
  if (arguments.meshes.any()) {
    std::string unusual;
    const auto made = arguments.meshes.read(arguments.volume, arguments.series,
                                            arguments.unusual ? &unusual : nullptr);
    return save(arguments, made, unusual);
  }
  const auto made =
      arguments.threshold_hu ? levels_of_threshold(arguments) : levels_of_labels(arguments);
  return save(arguments, made, made ? made->unusual : std::string());
}

void add_inputs(CLI::App& command, CaseArguments& arguments) {
  command
      .add_option(
          "--volume", arguments.volume,
          "CT: .nii, .nii.gz, .nrrd, or a folder of DICOM; with --labels or --mesh only to check "
          "that they lie on bone")
      ->check(some_text())
      ->type_name("SCAN");
  command
      .add_option("--series", arguments.series, "UID of the series, where a folder holds several")
      ->check(some_text());
  command.add_flag("--list", arguments.list,
                   "lists the DICOM series below --volume, makes nothing");
  command.add_flag("--unusual", arguments.unusual,
                   "goes on with an unusual count or size of vertebrae (four or six lumbar ones, a "
                   "child); the case notes it");
  command
      .add_option("--labels", arguments.labels,
                  "segmentation: .seg.nrrd of 3D Slicer, or a label map (.nii, .nii.gz, .nrrd)")
      ->check(some_text())
      ->type_name("FILE");
  command.add_option("--convention", arguments.convention, "what the numbers of a label map mean")
      ->check(some_text())
      ->type_name(joined(engine::label_conventions(), "|"));
  command
      .add_option("--threshold", arguments.threshold_hu,
                  "instead of --labels: connected bone of at least so many HU")
      ->check(finite_number(-1000, 3000));
  arguments.meshes.add_to(command);
  add_levels_option(command, arguments.levels, "levels (default: whole ones from T1 to L6)");
}

}  // namespace

void add_case_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("case", "Case folders");
  command->require_subcommand(1);
  auto arguments = std::make_shared<CaseArguments>();
  CLI::App* make = command->add_subcommand(
      "make", "Makes a case folder with vertebra meshes from a scan, or from meshes");
  add_inputs(*make, *arguments);
  make->add_option("--name", arguments->name, "name of the case (default: that of the folder)")
      ->check(some_text());
  make->add_option("-o,--out", arguments->out, "the case folder, without a case.json yet")
      ->check(some_text())
      ->type_name("DIR");
  arguments->json.add_to(*make);
  make->footer(
      "\nMeshes are closed, smooth, and as they lie in the scan (mm, LPS). Next: orthonav plan "
      "auto\n"
      "--case DIR (docs/planning.md).");
  make->callback([arguments, &action] { action = [arguments] { return run_make(*arguments); }; });
}

}  // namespace orthonav::tools
