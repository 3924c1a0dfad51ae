#include "study/left_out.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "engine/case/tool_file.h"
#include "engine/phantom/phantom.h"
#include "study/guided_statistics.h"
#include "study/study_definition.h"
#include "study/study_profile.h"

namespace orthonav::engine::left_out_test {
namespace {

using ::testing::HasSubstr;

TEST(LeftOut, EachStepIsSwitchedOffAlone) {
  OperationOptions options;
  options.use_reference = true;
  options.sim.guidance = sim::GuidanceProfile::kClosedLoop;
  ASSERT_TRUE(leave_out("tag-sizes", options).ok());
  EXPECT_FALSE(options.correct_tag_sizes);
  EXPECT_THAT(run_operation(phantom({"L5"}), options).error().message,
              HasSubstr("measurement model alone"));
  EXPECT_TRUE(options.session.steps.tips);
  EXPECT_TRUE(options.use_reference);
  EXPECT_EQ(options.sim.guidance, sim::GuidanceProfile::kClosedLoop);
  ASSERT_TRUE(leave_out("axis", options).ok());
  EXPECT_FALSE(options.session.steps.axis);
  EXPECT_TRUE(options.session.steps.wire);
  ASSERT_TRUE(leave_out("numbers", options).ok());
  EXPECT_EQ(options.sim.guidance, sim::GuidanceProfile::kNumbers);
  ASSERT_TRUE(leave_out("reference", options).ok());
  EXPECT_FALSE(options.use_reference);
  EXPECT_EQ(left_out_of(options), "tag sizes, axis, numbers, reference");
}

TEST(LeftOut, RefusesWhatIsNoStepAndWhatIsGoneAlready) {
  OperationOptions options;
  EXPECT_THAT(leave_out("thinking", options).error().message, HasSubstr("known: check points, "));
  ASSERT_TRUE(leave_out("wire", options).ok());
  EXPECT_THAT(leave_out("wire", options).error().message, HasSubstr("twice"));
}

TEST(LeftOut, IsPartOfWhatAStudyIs) {
  const Case spine = phantom({"L5"});
  StudyOptions options;
  options.operation.tools = built_in_tools();
  const std::string all = definition_of({&spine, 1}, options);
  ASSERT_TRUE(leave_out("redo", options.operation).ok());
  EXPECT_EQ(method_label(options.operation), "best without redo");
  EXPECT_NE(definition_of({&spine, 1}, options), all);
  StudyOptions longer;
  longer.operation.tools = built_in_tools();
  EXPECT_EQ(definition_of({&spine, 1}, longer), all);
  longer.operation.tools[0].tip_in_marker.v.y -= 0.01;
  EXPECT_NE(definition_of({&spine, 1}, longer), all) << "other tools are another study";
}

TEST(LeftOut, AProfileMayLeaveOutStepsAndUseTheReference) {
  const std::string text = R"({"name": "a", "method": "best", "guidance": "closed loop",
    "instrument": "sleeved drill", "reference": true, "without": ["tips", "numbers"]})";
  const auto profile = parse_profile(text, "file");
  ASSERT_TRUE(profile.ok()) << profile.error().message;
  OperationOptions options;
  profile->apply(options);
  EXPECT_TRUE(options.use_reference);
  EXPECT_FALSE(options.session.steps.tips);
  EXPECT_EQ(options.sim.guidance, sim::GuidanceProfile::kNumbers);
  const std::string wrong = R"({"name": "a", "method": "best", "guidance": "numbers",
    "instrument": "wire", "without": ["luck"]})";
  EXPECT_THAT(parse_profile(wrong, "file").error().message, HasSubstr("'luck'"));
}

OperationOptions modelled() {
  OperationOptions options;
  options.tools = built_in_tools();
  options.levels = {"L5"};
  options.measurement = Measurement::kModel;
  options.loop.draw_every = 0;
  options.session.live_clearance = false;
  options.sim.error_model = sim::ErrorModel::perfect();
  options.sim.error_model.pace = 4.0;
  options.sim.seed = 3;
  return options;
}

/// The mean over the screws of the guide's error across the plan; each screw has a figure.
double mean_across_m(const OperationOptions& options) {
  const Case spine = phantom({"L5"});
  const auto result = run_operation(spine, options);
  EXPECT_TRUE(result.ok());
  double sum_m = 0.0;
  int screws = 0;
  for (const ScrewTruth& screw : result->truth.levels[0].screws) {
    EXPECT_TRUE(screw.guided) << result->why_not;
    sum_m += screw.guided ? screw.guided->across_m : 0.0;
    ++screws;
  }
  return sum_m / screws;
}

TEST(GuidedError, IsThatOfTheNavigationAlone) {
  OperationOptions options = modelled();
  const double nothing_m = mean_across_m(options);
  EXPECT_LT(nothing_m, 0.0006);
  // The surgeon's hand and the wire do not affect it.
  options.sim.error_model.wire_skiving_m = 0.004;
  options.sim.error_model.wire_bending_rad = 0.05;
  EXPECT_LT(mean_across_m(options), nothing_m + 0.0003);
  // Errors of the tool's description do.
  options = modelled();
  options.session.steps.tips = false;
  options.sim.error_model.tip_calibration_m = 0.003;
  EXPECT_GT(mean_across_m(options), 0.0010);
}

nlohmann::ordered_json screw(double across_mm, double clearance_mm, bool warned, bool sure = true) {
  return {{"guided",
           {{"tip_mm", across_mm},
            {"across_mm", across_mm},
            {"angle_deg", 0.5},
            {"across_sds", across_mm},
            {"sure", sure}}},
          {"clearance_mm", clearance_mm},
          {"warned", warned}};
}

nlohmann::ordered_json guided_in(const nlohmann::ordered_json& run) {
  GuidedQuality quality;
  add_run(run, quality);
  return guided_json(quality);
}

TEST(GuidedError, SilentIsWhatIsFarOffAndWasNotTold) {
  nlohmann::ordered_json run;
  run["levels"] = {{{"label", "L5"},
                    {"screws",
                     {screw(2.5, 1.0, false), screw(2.5, 1.0, false, false), screw(2.5, -0.5, true),
                      screw(1.9, -0.1, false), screw(0.5, 1.0, false)}}}};
  const auto quality = guided_in(run);
  EXPECT_EQ(quality["silent_failures"]["n"], 1);
  EXPECT_EQ(quality["silent_failures"]["of"], 5);
  EXPECT_EQ(quality["far_off_without_warning"]["n"], 2);
  EXPECT_EQ(quality["shown_unsure"]["n"], 1);
  EXPECT_EQ(quality["within_shown_sds"]["in_68"], 1);
  EXPECT_EQ(quality["within_shown_sds"]["in_95"], 2);
  EXPECT_EQ(quality["unwarned_breaches"]["breaches"], 2);
  EXPECT_EQ(quality["unwarned_breaches"]["n"], 1);
  EXPECT_DOUBLE_EQ(quality["across_mm"]["mean"].get<double>(), 1.98);
  run["levels"][0]["screws"] = nlohmann::ordered_json::array();
  EXPECT_TRUE(guided_in(run).is_null());
}

}  // namespace
}  // namespace orthonav::engine::left_out_test
