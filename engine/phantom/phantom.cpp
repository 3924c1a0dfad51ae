#include "engine/phantom/phantom.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <map>
#include <utility>

#include "base/check.h"
#include "base/mutex.h"
#include "embedded/phantom_json.h"
#include "engine/phantom/phantom_file.h"
#include "engine/phantom/vertebra_shape.h"
#include "nav/geometry/implicit_surface.h"

namespace orthonav::engine {
namespace {

constexpr double kGridStep_m = 0.0014;
constexpr const char* kReferenceLevel = "L3";

/// The screw along the axis of a pedicle, entering where that axis meets the bone from behind.
nav::ScrewPlan screw_along(const nav::Axis<Vertebra>& axis, nav::Side side,
                           const nav::SurfaceIndex& bone, const PhantomParameters& parameters) {
  constexpr double kOutside_m = 0.080;
  const Vec3 outside = axis.point.v - kOutside_m * axis.direction;
  const auto hit = bone.first_hit(outside, axis.direction);
  const Vec3 entry = hit ? hit->point_m : axis.point.v;
  return {side,
          {entry},
          {entry + parameters.screw_length_m * axis.direction},
          0.5 * parameters.screw_diameter_m};
}

CaseLevel made(const VertebraMorphometry& morphometry, const PhantomParameters& parameters) {
  const VertebraShape shape(morphometry);
  CaseLevel level;
  level.label = morphometry.label;
  level.mesh = nav::surface_of([&shape](Vec3 p) { return shape.value(p); }, shape.low_m(),
                               shape.high_m(), kGridStep_m);
  const nav::SurfaceIndex bone(level.mesh);
  for (const nav::Side side : {nav::Side::kLeft, nav::Side::kRight}) {
    level.screws.push_back(screw_along(shape.pedicle_axis(side), side, bone, parameters));
  }
  return level;
}

Mat3 tilted(double angle_rad) { return rotation_from_vector({angle_rad, 0, 0}); }

/// From a body's middle down over half of the body, the disc, and half of the next body. Wedges
/// open to the front, so each step tilts the front of the next body downwards.
Transform<Spine, Vertebra> below(const Transform<Spine, Vertebra>& spine_from_upper,
                                 const VertebraMorphometry& upper,
                                 const VertebraMorphometry& lower) {
  const double half_angle_rad =
      0.5 * (0.5 * upper.wedge_rad() + upper.disc_wedge_rad + 0.5 * lower.wedge_rad());
  const double drop = 0.5 * upper.height_m() + upper.disc_height_m + 0.5 * lower.height_m();
  // On an arc, both halves of the tilt meet in the disc's middle: go down along the mean direction.
  const Transform<Spine, Vertebra> middle(spine_from_upper.rotation() * tilted(half_angle_rad),
                                          spine_from_upper.translation());
  return {middle.rotation() * tilted(half_angle_rad), (middle * Point<Vertebra>{{0, 0, -drop}}).v};
}

/// The place of each level, with the reference level at the origin.
std::vector<Transform<Spine, Vertebra>> places(const std::vector<VertebraMorphometry>& levels) {
  std::vector<Transform<Spine, Vertebra>> spine_from_vertebra(levels.size());
  std::size_t reference = 0;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    if (i > 0) {
      spine_from_vertebra[i] = below(spine_from_vertebra[i - 1], levels[i - 1], levels[i]);
    }
    if (levels[i].label == kReferenceLevel) {
      reference = i;
    }
  }
  const Transform<Spine, Vertebra> origin = spine_from_vertebra[reference];
  const Transform<Spine, Spine> rotated(origin.inverse().rotation(),
                                        origin.inverse().translation());
  for (auto& place : spine_from_vertebra) {
    place = rotated * place;
  }
  return spine_from_vertebra;
}

PhantomParameters built_in_parameters() {
  Result<PhantomParameters> read =
      phantom_parameters(embedded::phantom_json(), "data/phantom.json");
  ORTHONAV_CHECK(read.ok());
  return std::move(*read);
}

}  // namespace

std::vector<std::string> phantom_labels() {
  std::vector<std::string> labels;
  for (const VertebraMorphometry& level : built_in_parameters().levels) {
    labels.push_back(level.label);
  }
  return labels;
}

Case phantom(const std::vector<std::string>& labels) {
  const PhantomParameters parameters = built_in_parameters();
  const std::vector<Transform<Spine, Vertebra>> place = places(parameters.levels);
  // Each level is made once.
  static Mutex mutex;
  static std::map<std::string, std::shared_future<CaseLevel>> known;
  std::vector<std::shared_future<CaseLevel>> asked_for;
  for (std::size_t i = 0; i < parameters.levels.size(); ++i) {
    const VertebraMorphometry& morphometry = parameters.levels[i];
    const bool wanted = labels.empty() ||
                        std::find(labels.begin(), labels.end(), morphometry.label) != labels.end();
    if (!wanted) {
      continue;
    }
    const MutexLock lock(mutex);
    std::shared_future<CaseLevel>& level = known[morphometry.label];
    if (!level.valid()) {
      level = std::async(std::launch::async, [morphometry, parameters, at = place[i]] {
        CaseLevel one = made(morphometry, parameters);
        one.spine_from_vertebra = at;
        return one;
      });
    }
    asked_for.push_back(level);
  }
  Case spine;
  spine.name = parameters.name;
  for (const std::shared_future<CaseLevel>& level : asked_for) {
    spine.levels.push_back(level.get());
  }
  return spine;
}

}  // namespace orthonav::engine
