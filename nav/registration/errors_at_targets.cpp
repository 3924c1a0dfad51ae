#include "nav/registration/errors_at_targets.h"

#include <algorithm>

#include "nav/registration/degeneracy.h"

namespace orthonav::nav {

namespace {

/// Both ends of a bone along each of its principal axes, about.
std::vector<Point<Vertebra>> ends_of(const PrincipalAxes& bone) {
  constexpr double kEndSds = 2.0;
  std::vector<Point<Vertebra>> ends;
  for (std::size_t k = 0; k < 3; ++k) {
    for (const double side : {kEndSds, -kEndSds}) {
      ends.push_back({bone.centre_m + side * bone.deviation_m[k] * bone.axes[k]});
    }
  }
  return ends;
}

}  // namespace

std::vector<Point<Vertebra>> targets_of(const VertebraModel& model,
                                        const PoseSearchRegistrationOptions& options) {
  if (!options.targets.empty()) {
    return options.targets;
  }
  if (model.bone() == Bone::kAny) {
    return ends_of(model.reachable_axes());
  }
  // Pedicle screws enter about 20 mm beside the midline and end in the body.
  const Vec3 back = model.reachable_axes().centre_m;
  std::vector<Point<Vertebra>> usual;
  for (const double side : {1.0, -1.0}) {
    usual.push_back({back + Vec3{side * 0.020, 0.0, 0.0}});
    usual.push_back({back + Vec3{side * 0.008, -0.045, 0.0}});
  }
  return usual;
}

void put_errors(const VertebraModel& model, const PoseUncertainty& own, const CommonErrors& common,
                std::span<const Point<Vertebra>> targets, Registration& r) {
  r.predicted_tre_m = r.tre_95_m = r.tre_99_m = 0.0;
  for (const Point<Vertebra>& target : targets) {
    r.predicted_tre_m = std::max(r.predicted_tre_m, own.predicted_tre_m(target));
    r.tre_95_m = std::max(r.tre_95_m, own.tre_quantile_m(target, 0.95));
    r.tre_99_m = std::max(r.tre_99_m, own.tre_quantile_m(target, 0.99));
  }
  if (model.bone() == Bone::kVertebra) {  // whose places and motions have names
    const Degeneracy degeneracy = degeneracy_of(model, own, targets);
    r.weakest = degeneracy.motion;
    r.stroke_next = degeneracy.stroke_next;
    r.stroke_next_at = degeneracy.stroke_next_at;
  }
  r.common = common;
  r.uncertainty = with_common(own, common);
}

}  // namespace orthonav::nav
