#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "base/random.h"
#include "engine/phantom/phantom.h"
#include "nav/guidance/predicted_error.h"
#include "nav/registration/presses.h"
#include "tests/support/stroke_truths.h"

namespace orthonav::nav {

/// L4 of the phantom under soft tissue, stroked and registered to a model of it.
class StrokedBone {
 public:
  StrokedBone(std::shared_ptr<const VertebraModel> model, std::uint64_t seed, double tissue_m)
      : model_(std::move(model)),
        strokes_(orthonav::test::digitize_strokes(level().mesh,
                                                  orthonav::test::StrokeVariant::kFull, seed)
                     .value()),
        random_(seed) {
    orthonav::test::apply_truths({orthonav::test::Tissue::kSmooth, tissue_m, 0.0, 1}, level().mesh,
                                 seed, strokes_);
    options.targets = entries_and_targets(level().screws);
    points = strokes_.tips();
    registration = register_by_pose_search(*model_, points, options).value();
  }
  static const engine::CaseLevel& level() {
    static const auto kPhantom = engine::phantom({"L4"});
    return kPhantom.levels.at(0);
  }
  [[nodiscard]] const VertebraModel& model() const { return *model_; }
  [[nodiscard]] double error_m(const Registration& r) const {
    double worst = 0.0;
    for (const Point<Vertebra>& p : options.targets) {
      worst =
          std::max(worst, (r.world_from_vertebra * p - strokes_.world_from_vertebra * p).norm());
    }
    return worst;
  }

  PoseSearchRegistrationOptions options;
  std::vector<Point<World>> points;
  Registration registration;

 protected:
  std::shared_ptr<const VertebraModel> model_;
  orthonav::test::DigitizedStrokes strokes_;
  Random random_;
};

}  // namespace orthonav::nav
