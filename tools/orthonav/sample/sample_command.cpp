#include <cstdio>
#include <filesystem>
#include <memory>
#include <vector>

#include "base/printed.h"
#include "base/random.h"
#include "engine/case/case_writer.h"
#include "engine/case/screw_sizes.h"
#include "engine/case/tool_file.h"
#include "engine/io/atomic_file.h"
#include "engine/io/folders.h"
#include "engine/phantom/phantom.h"
#include "engine/print/board_file.h"
#include "engine/scan/scan_case.h"
#include "hal/sim/surgeon/stroke_plan.h"
#include "nav/planning/pedicle_screws.h"
#include "tools/orthonav/command.h"
#include "tools/orthonav/sample/sample_recording.h"
#include "tools/orthonav/sample/sample_scan.h"

namespace orthonav::tools {
namespace {

namespace fs = std::filesystem;

/// The levels of the sample, in the order of the spine.
const std::vector<std::string> kLevels = {"L4", "L5"};

/// The case that `case make` and `plan auto` make of the sample's labels.
Result<engine::Case> planned_case(const engine::Volume& labels) {
  const auto made = engine::scan_levels(labels, "verse", {});
  if (!made) {
    return made.error();
  }
  engine::Case subject = engine::case_of(*made, "sample");
  const auto sizes = engine::ScrewSizes::built_in().implants();
  for (engine::CaseLevel& level : subject.levels) {
    const auto screws = nav::plan_pedicle_screws(level.mesh, nav::SurfaceIndex(level.mesh), sizes);
    if (!screws) {
      return screws.error();
    }
    for (const auto& side : screws->sides) {
      if (!side) {
        return side.error();
      }
      level.screws.push_back(side->plan);
    }
  }
  return subject;
}

/// The screws as they might lie after the operation: a millimetre and a degree or so off.
std::vector<MetalScrew> placed_screws(const engine::Case& subject) {
  std::vector<MetalScrew> placed;
  Random random(4);
  const auto off_m = [&random] {
    constexpr double kSd_m = 0.0006;
    return Vec3{random.normal(0, kSd_m), random.normal(0, kSd_m), random.normal(0, kSd_m)};
  };
  for (const engine::CaseLevel& level : subject.levels) {
    for (const nav::ScrewPlan& plan : level.screws) {
      const Vec3 entry_m = plan.entry.v + off_m();
      placed.push_back({entry_m, plan.target.v + off_m(), plan.radius_m});
    }
  }
  return placed;
}

/// Strokes over the back of L4, half a millimetre apart, in a frame of a tracker's own.
std::string digitized(const engine::CaseLevel& level) {
  const sim::RoomLevel bone{level.label, level.mesh.vertices_m, level.mesh.triangles, {}};
  const Mat3 turned = rotation_from_vector({1.2, -0.6, 2.1});
  std::string text = "x,y,z,time_s\n";
  Random random(2);
  double time_s = 0.0;
  for (const sim::StrokeRegion& region : sim::plan_strokes(bone)) {
    for (const sim::Stroke& stroke : region.strokes) {
      for (const sim::BoneSpot& spot : stroke.spots) {
        constexpr double kNoise_m = 0.0003;
        const Vec3 noise_m{random.normal(0, kNoise_m), random.normal(0, kNoise_m),
                           random.normal(0, kNoise_m)};
        const Vec3 tip_mm = 1e3 * (turned * (spot.point + noise_m) + Vec3{0.2, 0.9, -0.4});
        text += printed("%.2f,%.2f,%.2f,%.3f\n", tip_mm.x, tip_mm.y, tip_mm.z, time_s);
        time_s += 0.025;
      }
      time_s += 1.0;
    }
  }
  return text;
}

/// That of docs/accuracy-test.md.
engine::Board board() {
  engine::Board board;
  board.kind = engine::BoardKind::kTags;
  board.columns = 5;
  board.rows = 6;
  board.size_m = 0.025;
  board.gap_m = 0.008;
  board.ids = engine::consecutive_ids(board.kind, board.columns, board.rows, 0);
  return board;
}

Status write_recordings(const fs::path& folder) {
  std::vector<Vec2> points_m;
  for (const engine::TouchPoint& point : engine::touch_points(board())) {
    points_m.push_back(point.at_m);
  }
  for (const Status& status :
       {engine::save_board(folder / "board.json", board()), record_pivoting(folder / "pivoting")}) {
    if (!status) {
      return status;
    }
  }
  return record_accuracy_test(folder / "accuracy", points_m);
}

/// Everything, into an existing folder.
Status write_sample(const fs::path& folder) {
  const engine::Case phantom = engine::phantom(kLevels);
  const SampleScan before = scan_of(phantom, {});
  const auto subject = planned_case(before.labels);
  if (!subject) {
    return subject.error();
  }
  if (const auto made = engine::make_folders(folder / "case"); !made) {
    return made.error();
  }
  const SampleScan after = scan_of(phantom, placed_screws(*subject));
  for (const Status& status :
       {engine::save_case(folder / "case", *subject), save_scan(folder / "ct.nrrd", before.ct),
        save_scan(folder / "labels.nrrd", before.labels),
        save_scan(folder / "after.nrrd", after.ct),
        engine::write_file(folder / "points.csv", digitized(subject->levels.front())),
        engine::save_tools(folder / "tools.json", sample_tools())}) {
    if (!status) {
      return status;
    }
  }
  return write_recordings(folder);
}

/// Refuses a place where something is.
Status check_free(const fs::path& folder, const fs::path& part) {
  std::error_code code;
  if (fs::exists(folder, code) && !(fs::is_directory(folder, code) && fs::is_empty(folder, code))) {
    return Error{folder.string() + ": already exists and is not an empty folder; name a new one"};
  }
  return fs::exists(part, code)
             ? Status(
                   Error{part.string() + ": left over from a sample that was cut off; remove it"})
             : Status{};
}

int run_sample(const std::string& name) {
  const fs::path folder = (fs::path(name) / "").lexically_normal().parent_path();
  const fs::path part = folder.string() + ".part";
  if (const Status free = check_free(folder, part); !free) {
    return bad_input(free.error().message);
  }
  const auto made = engine::make_folders(part);
  if (!made) {
    return bad_input(made.error().message);
  }
  std::error_code code;
  if (const Status written = write_sample(part); !written) {
    fs::remove_all(part, code);
    engine::remove_empty(*made);
    return bad_input(written.error().message);
  }
  fs::rename(part, folder, code);  // over an empty folder too
  if (code) {
    return bad_input(folder.string() + ": cannot be written: " + code.message());
  }
  std::printf(
      "%s: tools.json, points.csv, case, ct.nrrd, labels.nrrd, after.nrrd, board.json, pivoting, "
      "accuracy\n",
      folder.c_str());
  return kDone;
}

constexpr const char* kSampleFooter =
    "\ntools.json   the built-in pointer, drill guide and patient reference; the pointer's tip is "
    "1.5 mm\n"
    "             off, as if found with a ruler\n"
    "ct.nrrd      a computed CT of L4 and L5 of the built-in phantom, labels.nrrd its "
    "segmentation\n"
    "             (--convention verse)\n"
    "case         the case that case make and plan auto make of them\n"
    "points.csv   strokes over the back of L4: register --case DIR/case --level L4 --points ...\n"
    "pivoting     a recording of the pointer in a dimple: calibrate pivot, track\n"
    "accuracy     one of the accuracy test, board.json its board: accuracy\n"
    "after.nrrd   a CT of the same patient with its screws: evaluate\n"
    "docs/first-screw.md goes through them.";

}  // namespace

void add_sample_command(CLI::App& app, Action& action) {
  auto folder = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand(
      "sample", "Writes tools, points, a scan, a case and recordings to try things with");
  command->add_option("DIR", *folder, "A new folder, or an empty one")->required();
  command->footer(kSampleFooter);
  command->callback([folder, &action] { action = [folder] { return run_sample(*folder); }; });
}

}  // namespace orthonav::tools
