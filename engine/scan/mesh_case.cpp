#include "engine/scan/mesh_case.h"

#include <algorithm>
#include <utility>

#include "engine/case/likely_mistakes.h"
#include "engine/scan/level_places.h"

namespace orthonav::engine {
namespace {

Status check_names(const std::vector<CaseLevel>& meshes) {
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const std::string& label = meshes[i].label;
    if (!place_in_spine(label)) {
      return Error{"'" + label + "' is not a vertebra (C1-C7, T1-T13, L1-L6, S1)"};
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (meshes[j].label == label) {
        return Error{label + " is given twice"};
      }
    }
  }
  return {};
}

}  // namespace

Result<std::vector<MeshLevel>> mesh_levels(std::vector<CaseLevel> meshes, std::string* unusual) {
  if (Status s = check_names(meshes); !s) {
    return s.error();
  }
  std::sort(meshes.begin(), meshes.end(), [](const CaseLevel& a, const CaseLevel& b) {
    return place_in_spine(a.label) < place_in_spine(b.label);
  });
  std::vector<LevelPlace> places;
  for (const CaseLevel& level : meshes) {
    places.push_back({level.label, nav::bounds_of(level.mesh).centre()});
  }
  const Case together{"", {}, std::move(meshes), {}};
  for (std::size_t i = 1; i < together.levels.size(); ++i) {
    if (const CaseLevel* other = together.overlapped_by(i)) {
      return Error{together.levels[i].label + " lies in the same place as " + other->label +
                   ": each is in a frame of its own; the meshes must be of one scan"};
    }
  }
  if (Status s =
          check_places(places, "are these meshes of one scan, with their own names?", unusual);
      !s) {
    return s.error();
  }
  std::vector<MeshLevel> levels;
  for (const CaseLevel& level : together.levels) {
    const auto canal = has_canal(level.mesh);
    if (!canal) {
      return Error{level.label + " " + canal.error().message};
    }
    levels.push_back({level, nav::solid_of(level.mesh).volume_m3, *canal});
  }
  return levels;
}

Status check_on_bone(const std::vector<MeshLevel>& levels, const Volume& scan) {
  constexpr double kStep_m = 0.002;
  auto samples = BoneSamples::in(scan);
  if (!samples) {
    return samples.error();
  }
  for (const MeshLevel& made : levels) {
    const nav::SurfaceIndex bone(made.level.mesh);
    const nav::Bounds box = nav::bounds_of(made.level.mesh);
    for (double z = box.low.z; z <= box.high.z; z += kStep_m) {
      for (double y = box.low.y; y <= box.high.y; y += kStep_m) {
        for (double x = box.low.x; x <= box.high.x; x += kStep_m) {
          if (bone.contains({x, y, z})) {
            samples->add({x, y, z});
          }
        }
      }
    }
  }
  return samples->check("meshes");
}

}  // namespace orthonav::engine
