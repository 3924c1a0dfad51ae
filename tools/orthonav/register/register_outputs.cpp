#include "tools/orthonav/register/register_outputs.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "engine/io/atomic_file.h"
#include "engine/report/registration_page.h"
#include "engine/scan/transform_file.h"

namespace orthonav::tools {
namespace {

/// Where 3D Slicer keeps markups and models: the patient's axes, LPS.
struct SlicerWorld;

/// `world_from_vertebra` has its points in the axes that their file states.
Transform<SlicerWorld, Vertebra> in_slicer(const Transform<World, Vertebra>& world_from_vertebra,
                                           engine::Axes axes) {
  const Mat3 half_turn{{{{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}}}};
  const Transform<SlicerWorld, World> slicer_from_world(
      axes == engine::Axes::kRas ? half_turn : Mat3::identity(), {});
  return slicer_from_world * world_from_vertebra;
}

}  // namespace

Status RegisterOutputs::check() const {
  if (const Status s = json.check(); !s) {
    return s;
  }
  if (!report.empty()) {
    if (const Status s = engine::check_place(report); !s) {
      return s;
    }
  }
  if (transform.empty()) {
    return {};
  }
  const Status name = engine::check_transform_name(transform);
  return name ? engine::check_place(transform) : name;
}

Status RegisterOutputs::check_inputs(const RegisterInputs& inputs,
                                     const std::string& points) const {
  if (transform.empty() || inputs.points_axes) {
    return {};
  }
  return Error{"--transform: " + points +
               " states no axes; save the points as 3D Slicer markups (.mrk.json, .fcsv)"};
}

Status RegisterOutputs::write(const engine::RegisteredLevel& level, const RegisterInputs& inputs,
                              const std::string& points) const {
  if (!report.empty()) {
    const auto page =
        engine::registration_page(level, std::filesystem::path(points).filename().string());
    if (!page) {
      return page.error();
    }
    if (const Status s = engine::write_file(report, *page); !s) {
      return s;
    }
  }
  if (!transform.empty() && inputs.points_axes && level.registration.accepted) {
    const auto pose = in_slicer(level.registration.world_from_vertebra, *inputs.points_axes);
    if (const Status s = engine::save_transform(transform, engine::stored(pose)); !s) {
      return s;
    }
  }
  return json.write(engine::registration_json(level, inputs.frame));
}

}  // namespace orthonav::tools
