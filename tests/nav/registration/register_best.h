#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/phantom/phantom.h"
#include "nav/registration/registration.h"
#include "tests/support/digitized_strokes.h"
#include "tests/support/refusal_kinds.h"

namespace orthonav::nav::registration_best_test {

using Points = std::vector<Point<World>>;

/// The largest tolerable error at a screw; a larger one that is accepted is a silent failure.
inline constexpr double kSilent_m = 0.002;

struct Level {
  engine::CaseLevel from;
  std::shared_ptr<const VertebraModel> model;
};

/// The built-in phantom's levels, each made when it is first asked for, and strokes over all that a
/// pointer reaches of L4.
class RegisterBest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    full_ = test::digitize_strokes(l4().from.mesh, test::StrokeVariant::kFull, 1).value();
  }
  static void TearDownTestSuite() { levels_.clear(); }
  static const Level& level(const std::string& label) {
    const auto known = levels_.find(label);
    if (known != levels_.end()) {
      return known->second;
    }
    Level made{engine::phantom({label}).levels.at(0), {}};
    made.model = VertebraModel::prepare(made.from.mesh).value();
    return levels_.emplace(label, std::move(made)).first->second;
  }
  static const Level& l4() { return level("L4"); }
  static PoseSearchRegistrationOptions options(const Level& of,
                                               const std::vector<std::string>& neighbours = {}) {
    PoseSearchRegistrationOptions o;
    for (const ScrewPlan& screw : of.from.screws) {
      o.targets.insert(o.targets.end(), {screw.entry, screw.target});
    }
    for (const std::string& label : neighbours) {
      o.neighbours.push_back({label, level(label).model.get()});
    }
    return o;
  }
  static Result<Registration> registered(const Points& points) {
    return register_by_pose_search(*l4().model, points, options(l4()));
  }
  static double error_m(const Level& of, const Transform<World, Vertebra>& pose,
                        const Transform<World, Vertebra>& truth) {
    double worst = 0.0;
    for (const Point<Vertebra>& p : options(of).targets) {
      worst = std::max(worst, (pose * p - truth * p).norm());
    }
    return worst;
  }
  /// Expects a refusal, each of whose reasons is beyond its limit.
  static void expect_refused(const Points& points, const std::string& what) {
    using Kind = RefusalReason::Kind;
    const auto r = registered(points);
    ASSERT_TRUE(r.ok()) << what << ": " << r.error().message;
    EXPECT_FALSE(r->accepted) << what;
    EXPECT_FALSE(r->reasons.empty()) << what;
    for (const RefusalReason& reason : r->reasons) {
      const bool at_least =
          reason.kind == Kind::kLogLikelihoodRatio || reason.kind == Kind::kInliers;
      const double value =
          reason.kind == Kind::kModelSize ? std::abs(reason.value - 1.0) : reason.value;
      EXPECT_TRUE(at_least ? value < reason.limit : value > reason.limit)
          << what << ": " << value << " of " << reason.limit;
    }
  }
  static inline std::map<std::string, Level> levels_;
  static inline test::DigitizedStrokes full_;
};

}  // namespace orthonav::nav::registration_best_test
