#include "tools/orthonav/case/case_meshes.h"

#include <nlohmann/json.hpp>

#include "engine/io/mesh_file.h"
#include "tools/orthonav/shared/arguments.h"
#include "tools/orthonav/shared/case_source.h"
#include "tools/orthonav/shared/print_text.h"

namespace orthonav::tools {
namespace {

/// `LEVEL=FILE`.
Result<engine::CaseLevel> read_level(const std::string& given, double metres_per_unit,
                                     const std::string& frame) {
  const std::size_t equals = given.find('=');
  if (equals == std::string::npos) {
    return Error{"--mesh: " + given + ": must be LEVEL=FILE, as in L4=l4.stl"};
  }
  const std::string file = given.substr(equals + 1);
  const auto stated = engine::axes_from(frame);
  if (!stated && !engine::declared_axes(file)) {
    // A file that can't be read has its own reason.
    const auto mesh = engine::load_mesh(file, metres_per_unit);
    return mesh ? Error{file + ": does not say its axes; state them with --frame LPS or RAS"}
                : mesh.error();
  }
  std::string note;
  auto mesh = engine::load_mesh(file, metres_per_unit, stated.value_or(engine::Axes::kLps), &note);
  if (!mesh) {
    return mesh.error();
  }
  if (!note.empty()) {
    print_warning(note);
  }
  return engine::CaseLevel{given.substr(0, equals), *std::move(mesh), {}, {}};
}

}  // namespace

void CaseMeshes::add_to(CLI::App& command) {
  command
      .add_option(
          "--mesh", files_,
          "instead of --labels: the mesh of a vertebra (STL, PLY or OBJ), once for each level")
      ->type_name("LEVEL=FILE")
      ->allow_extra_args(false);
  command.add_option("--units", units_, "unit of the files of --mesh")
      ->check(CLI::IsMember({"mm", "m"}))
      ->capture_default_str();
  command.add_option("--frame", frame_, "axes of the files of --mesh that declare none")
      ->check(CLI::IsMember({"LPS", "RAS"}));
}

Result<std::vector<engine::MeshLevel>> CaseMeshes::read(const std::string& volume,
                                                        const std::string& series,
                                                        std::string* unusual) const {
  std::vector<engine::CaseLevel> meshes;
  for (const std::string& given : files_) {
    auto level = read_level(given, *engine::metres_per_unit_from(units_), frame_);
    if (!level) {
      return level.error();
    }
    meshes.push_back(*std::move(level));
  }
  auto levels = engine::mesh_levels(std::move(meshes), unusual);
  if (!levels) {
    return Error{"--mesh: " + levels.error().message, levels.error().code};
  }
  if (!volume.empty()) {
    const auto scan = load_scan(volume, series);
    if (!scan) {
      return scan.error();
    }
    if (Status s = engine::check_on_bone(*levels, *scan); !s) {
      return Error{volume + ": " + s.error().message, s.error().code};
    }
  }
  return levels;
}

engine::Case case_of(const std::vector<engine::MeshLevel>& made, const std::string& name) {
  engine::Case out{name, {}, {}, {}};
  for (const engine::MeshLevel& each : made) {
    out.levels.push_back(each.level);
  }
  return out;
}

nlohmann::ordered_json levels_json(const std::vector<engine::MeshLevel>& made) {
  nlohmann::ordered_json out = {{"levels", nlohmann::ordered_json::array()}};
  for (const engine::MeshLevel& each : made) {
    out["levels"].push_back({{"label", each.level.label},
                             {"canal", each.canal},
                             {"triangles", each.level.mesh.triangles.size()},
                             {"volume_cm3", each.volume_m3 * 1e6}});
  }
  return out;
}

void print(const std::vector<engine::MeshLevel>& made) {
  for (const engine::MeshLevel& each : made) {
    print_text("%s: %zu triangles, %.1f cm3\n", each.level.label.c_str(),
               each.level.mesh.triangles.size(), each.volume_m3 * 1e6);
  }
}

}  // namespace orthonav::tools
