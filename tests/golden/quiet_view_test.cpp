// How much there is to read in each step, and that nothing of it is cut or lies where it can't be
// read.
#include <gmock/gmock.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "base/angle.h"
#include "base/printed.h"
#include "base/translation.h"
#include "engine/golden/golden_operation.h"
#include "engine/golden/golden_scenes.h"
#include "engine/holograms/labels/label_geometry.h"
#include "engine/holograms/labels/label_obstacles.h"
#include "engine/holograms/labels/label_places.h"
#include "engine/holograms/shapes/hologram_label.h"
#include "engine/holograms/shapes/hologram_shapes.h"
#include "engine/session/text/wording.h"
#include "render/frame/frame_items.h"
#include "render/text/font.h"
#include "tests/support/language_in_use.h"
#include "tools/orthonav/language/language_file.h"

namespace orthonav::engine {
namespace {

// What a surgeon with a drill in the hand reads at a glance (docs/holograms.md).
constexpr int kMaxNumbers = 4;
constexpr int kMaxWords = 8;
/// To the edge of a view.
constexpr float kDigit = 0.006f;

struct Reading {
  int numbers = 0;
  int words = 0;
};

/// A number with its unit is one, `L4` is a word, and marks are neither.
Reading to_read(const render::Scene& scene) {
  Reading reading;
  for (const render::TextItem& item : scene.texts) {
    std::string all;
    for (const render::TextRun& run : item.runs) {
      all += run.text;
    }
    std::istringstream tokens(all);
    for (std::string token; tokens >> token;) {
      const auto letter = [](unsigned char c) { return std::isalpha(c) != 0; };
      if (std::isdigit(static_cast<unsigned char>(token.front())) != 0) {
        ++reading.numbers;
      } else if (std::any_of(token.begin(), token.end(), letter) && !token.starts_with("mm")) {
        ++reading.words;
      }
    }
  }
  return reading;
}

GoldenScene scene_named(const std::string& name, bool laid_out = true) {
  for (GoldenScene& golden : golden_scenes(laid_out)) {
    if (golden.name == name) {
      return golden;
    }
  }
  ADD_FAILURE() << name << " is no golden scene";
  return {};
}

std::string count_row(const std::string& step) {
  std::ifstream file(ORTHONAV_SOURCE_DIR "/tests/golden/legibility.md");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("| scene `" + step + "` |")) {
      return line;
    }
  }
  return {};
}

void expect_quiet(const render::Scene& scene, const std::string& name) {
  const Reading reading = to_read(scene);
  EXPECT_LE(reading.numbers, kMaxNumbers) << name;
  EXPECT_LE(reading.words, kMaxWords) << name;
}

TEST(QuietView, HasFourNumbersAndEightWordsAtMostInEveryStepWithinLimits) {
  for (const char* name :
       {"setup", "digitizing", "verify", "verify_checked", "verify_many", "landmark", "guide_far",
        "guide_aside", "guide_set", "guide_drilling", "measure", "h10_rod", "done"}) {
    expect_quiet(scene_named(name).scene, name);
  }
  for (const char* name : {"guide_numbers", "h10_rod_moved"}) {
    const Reading all = to_read(scene_named(name).scene);
    EXPECT_GT(all.numbers, kMaxNumbers) << "the control: every number, on request";
    EXPECT_GT(all.words, kMaxWords);
  }
}

/// What else a step asks for, beside all that it shows.
void expect_quiet_whatever_is_asked() {
  using Advice = nav::CheckAdvice::Kind;
  const auto expect_with = [](golden::StagedOperation& s, const StepState& state) {
    s.guidance.status.state = state;
    // Most acts are saved at once.
    for (const Saved saved : {Saved::kNothingNew, Saved::kSaved}) {
      s.guidance.status.saved = saved;
      const GoldenScene golden = s.scene("", "");
      expect_quiet(golden.scene, detail_text(s.guidance.status));
      EXPECT_GE(to_read(golden.scene).words, 3) << "the step and an act";
    }
  };
  golden::StagedOperation digitize(Step::kDigitize);
  for (const auto part : {nav::BonePlace::Part::kLamina, nav::BonePlace::Part::kFacet}) {
    for (const bool enough : {false, true}) {
      digitize.coaching.enough = digitize.coaching.then_touch = enough;
      digitize.coaching.stroke_next = {part, nav::Side::kRight, nav::BonePlace::Height::kLower};
      expect_with(digitize, StrokesSoFar{800, &digitize.coaching});
    }
  }
  golden::StagedOperation verify(Step::kVerify);
  verify.level().check_points = {{{{0, 0.057, -0.014}}, 0.0004, true}};
  for (const nav::CheckAdvice& advice : {nav::CheckAdvice{Advice::kTouchApart, 3, 0.015, 0.0},
                                         {Advice::kTouchApart, 2, 0.015, 0.0},
                                         {Advice::kTouchOffLine, 1, 0.005, 0.0},
                                         {Advice::kTouchMore, 1, 0.0026, 0.002},
                                         {Advice::kReject, 4, 0.0031, 0.002},
                                         {Advice::kUncertain, 1, 0.0026, 0.002}}) {
    const nav::CheckVerdict verdict{false, 0.0, advice};
    expect_with(verify, ChecksSoFar{&verdict});
  }
  expect_with(verify, ByEye{});
  golden::StagedOperation accepted(Step::kTouchLandmark);
  accepted.level().screws[1].done = false;
  const TipCheck any_way(0.0007);
  TipCheck as_for_screw(0.0007);
  as_for_screw.expect();
  const TipCheck nobody(0.0007, false);
  for (const TipCheck* tips :
       std::initializer_list<const TipCheck*>{&any_way, &as_for_screw, &nobody}) {
    for (const int missing : {0, 1}) {
      expect_with(accepted, LandmarkSoFar{true, LandmarkTouch{true, missing, 0.0, 0.0015}, tips});
    }
  }
  expect_with(accepted, LandmarkSoFar{});
  for (const Message& corrected : {Message(TipCorrected{0.0009}), Message(AxisCorrected{0.026})}) {
    accepted.guidance.status.message = &corrected;
    expect_with(accepted, LandmarkSoFar{true, LandmarkTouch{true, 0, 0.0, 0.0015}, &any_way});
  }
  golden::StagedOperation placed(Step::kMeasureWire);
  expect_with(placed, WireSoFar{});
  golden::StagedOperation rod(Step::kRod);
  HeadsSoFar heads;
  heads.unplanned = true;
  expect_with(rod, heads);
  for (const std::size_t bends : {0u, 2u}) {
    expect_with(rod, HeadsSoFar{2, 0.082, bends});
  }
}

TEST(QuietView, HasNoMoreWhateverAStepAsksFor) { expect_quiet_whatever_is_asked(); }

TEST(QuietView, HasNoMoreInGerman) {
  auto german = tools::language_named("de");
  ASSERT_TRUE(german) << german.error().message;
  const test::LanguageInUse in_use(*std::move(german));
  const WearersLanguage language;
  expect_quiet_whatever_is_asked();
}

TEST(QuietView, HasAsMuchToReadAsTheTableSays) {
  for (const char* name : {"setup", "digitizing", "verify", "verify_checked", "landmark",
                           "guide_far", "guide_aside", "guidance", "guide_set", "guide_drilling",
                           "guide_stop", "guide_numbers", "measure", "h10_rod", "done"}) {
    const Reading reading = to_read(scene_named(name).scene);
    const std::string row =
        printed("| scene `%s` | %d | %d |", name, reading.numbers, reading.words);
    std::printf("%s\n", row.c_str());
    EXPECT_EQ(count_row(name), row) << "tests/golden/legibility.md is stale";
  }
}

/// The grades whose colours a scene of guiding shows, apart from the plan (always green) and the
/// dots of the tools.
std::set<Grade> grades_in(const render::Scene& scene) {
  std::set<Grade> grades;
  const auto look = [&](render::Label label, const render::Colour& colour) {
    const HologramKind kind = kind_of(label);
    if (kind == HologramKind::kTrajectory || kind == HologramKind::kStatus || !(colour.a > 0)) {
      return;
    }
    for (const Grade grade : {Grade::kGood, Grade::kFair, Grade::kPoor}) {
      const render::Colour of_grade = colour_of(grade);
      if (colour.r == of_grade.r && colour.g == of_grade.g && colour.b == of_grade.b) {
        grades.insert(grade);
      }
    }
  };
  for (const auto& item : scene.meshes) {
    look(item.label, item.colour);
  }
  for (const auto& item : scene.triangles) {
    look(item.label, item.colour);
  }
  for (const auto& item : scene.lines) {
    look(item.label, item.colour);
  }
  for (const auto& item : scene.texts) {
    look(item.label, item.rim);
    for (const render::TextRun& run : item.runs) {
      look(item.label, run.colour);
    }
  }
  return grades;
}

TEST(QuietView, ShowsOneVerdictOfWhateverIsWorstInEveryGuidingStep) {
  using golden::guided;
  std::map<Grade, int> count;
  for (const double angle_deg : {0.4, 3.0, 6.5}) {
    for (const double beside_m : {0.0003, 0.0015, 0.0033}) {
      for (const double depth_m : {-0.006, 0.0002, 0.014, 0.046}) {
        for (const double sd_m : {0.0002, 0.0014}) {
          for (const nav::ShownClearance& clearance :
               {nav::ShownClearance{24, 11, "medial"}, nav::ShownClearance{6, -3, "medial"},
                nav::ShownClearance{-4, -12, "medial"}}) {
            golden::StagedOperation s(Step::kGuide);
            const nav::ScrewGuidance tool = guided(angle_deg, beside_m, depth_m);
            s.measure(tool, {sd_m, 0.2 * kRadiansPerDegree});
            s.guidance.tool->shown_clearance = clearance;
            s.guidance.drill = {nav::DrillPhase::kSet, nav::DrillAlarm::kNone, true};
            const render::Scene scene = s.scene("", "").scene;
            const Grade worst =
                std::max({grade_of(tool.angle_rad), grade_of_offset(tool.tip_off_axis_m),
                          sd_m > 0.001 ? Grade::kFair : Grade::kGood,
                          clearance.least_tenths < 0       ? Grade::kPoor
                          : *clearance.lower_95_tenths < 0 ? Grade::kFair
                                                           : Grade::kGood,
                          tool.to_target_m < 0 ? Grade::kPoor : Grade::kGood});
            EXPECT_THAT(grades_in(scene), ::testing::ElementsAre(worst))
                << angle_deg << "°, " << beside_m << " m, depth " << depth_m << " m, SD " << sd_m
                << " m, clearance " << clearance.least_tenths;
            const Reading reading = to_read(scene);
            EXPECT_LE(reading.numbers, kMaxNumbers);
            if (worst == Grade::kGood) {
              EXPECT_LE(reading.words, kMaxWords);
            }
            ++count[worst];
          }
        }
      }
    }
  }
  EXPECT_EQ(count.size(), 3u) << "the control: every verdict came";
  render::Scene mixed = scene_named("guide_beside").scene;
  for (render::TextItem& text : mixed.texts) {
    if (kind_of(text.label) == HologramKind::kAngle) {
      text.rim = colour_of(Grade::kGood);
    }
  }
  EXPECT_EQ(grades_in(mixed).size(), 2u) << "the control: a green angle beside a red offset";
}

/// The texts that an edge of a view cuts, or that lie on paper or on the planned trajectory.
int unreadable(const GoldenScene& golden) {
  const render::Font font;
  const Eyes eyes(golden.views);
  std::vector<LabelObstacle> obstacles;
  find_obstacles(golden.scene, golden.papers, eyes, obstacles);
  int count = 0;
  for (const render::TextItem& text : golden.scene.texts) {
    if (text.runs.empty()) {
      continue;
    }
    LabelExtent extent;
    extent.width = render::line_width(font, text);
    const BoxInEyes box = eyes.box(render::world_from_caps(text, eyes.head()),
                                   box_at(place_of(text, extent, 0), extent));
    const bool covers =
        std::any_of(obstacles.begin(), obstacles.end(), [&](const LabelObstacle& obstacle) {
          const bool line = obstacle.kind == LabelObstacle::Kind::kLine &&
                            kind_of(obstacle.label) == HologramKind::kTrajectory;
          return (line || obstacle.kind == LabelObstacle::Kind::kGlare) &&
                 overlap(obstacle.seen, box);
        });
    count += covers || !eyes.in_view(grown(box, 0.9f * kDigit)) ? 1 : 0;
  }
  return count;
}

TEST(QuietView, CutsNothingAndCoversNeitherPaperNorTrajectory) {
  for (const char* name : {"labels_left_edge", "labels_right_edge", "labels_off_tag",
                           "labels_status_off_tag", "labels_off_trajectory", "labels_low"}) {
    // Of the others, BlockPlace.GoesOffPaperAndOffTheTrajectory has the controls.
    if (std::string(name).ends_with("_edge") || std::string(name).ends_with("off_tag")) {
      EXPECT_GT(unreadable(scene_named(name, false)), 0) << name << ": the control, as built";
    }
    EXPECT_EQ(unreadable(scene_named(name)), 0) << name;
  }
  for (const GoldenScene& golden : golden_scenes()) {
    if (golden.name.starts_with("guid")) {
      EXPECT_EQ(unreadable(golden), 0) << golden.name;
    }
  }
}

}  // namespace
}  // namespace orthonav::engine
