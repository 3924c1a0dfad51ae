#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/angle.h"
#include "base/reason.h"
#include "base/translation.h"
#include "engine/golden/golden_stage.h"
#include "engine/session/coach.h"
#include "engine/session/text/wording.h"
#include "render/projection.h"
#include "tests/golden/expected_box.h"
#include "tests/support/language_in_use.h"
#include "tools/orthonav/language/language_file.h"

namespace orthonav::engine {
namespace {

using ::testing::HasSubstr;

const nav::BonePlace kFarPlace{nav::BonePlace::Part::kFacet, Side::kRight,
                               nav::BonePlace::Height::kLower};
/// What no message may hide, and what it asks for, in the language in use.
struct Told {
  std::string lost;
  std::string not_saved;
  std::string stroke;
};
const Told kEnglish{"reference lost", "NOT SAVED", "digitize the right lower facet"};
const Told kGerman{"reference verloren", "NICHT GESICHERT", "abfahren: Facette unten rechts"};

struct ShownOn {
  std::string name;
  int width_px;
  int height_px;
  std::vector<render::View> views;
};

/// The narrowest display with eyes as far apart as a head has them, and the pictures of people.
std::vector<ShownOn> displays() {
  const auto window = [](int width_px, int height_px, double half_angle_deg) {
    const auto across = static_cast<float>(std::tan(half_angle_deg * kRadiansPerDegree));
    return render::look_at({0, 0.4f, 0}, {}, {0, 0, 1}, across,
                           across * static_cast<float>(height_px) / static_cast<float>(width_px));
  };
  const render::View hololens2 = window(1440, 936, 21.5);
  return {{"HoloLens 2, eyes 56 mm apart", 1440, 936, render::stereo_pair(hololens2, 0.056f)},
          {"HoloLens 2, eyes 72 mm apart", 1440, 936, render::stereo_pair(hololens2, 0.072f)},
          {"golden pictures", 720, 468, golden::surgeon_views()},
          {"film", 1152, 748, {window(1152, 748, 21.5)}},
          {"preview", 1120, 720, {window(1120, 720, 27.0)}}};
}

nav::RefusalReason reason(nav::RefusalReason::Kind kind) {
  return {kind, 0.0204, 0.0150,
          nav::UncertainMotion{nav::UncertainMotion::Kind::kCraniocaudal, 0.03}, "L3"};
}

RegistrationRefused refused_for_everything() {
  RegistrationRefused refused;
  for (int kind = 0; kind <= static_cast<int>(nav::RefusalReason::Kind::kFitsOtherLevel); ++kind) {
    refused.reasons.push_back(reason(static_cast<nav::RefusalReason::Kind>(kind)));
  }
  refused.stroke_next = kFarPlace;
  return refused;
}

/// The longest message of every kind.
std::vector<Message> messages() {
  using What = TouchNotRecorded::What;
  using Advice = nav::CheckAdvice::Kind;
  RegistrationRefused error;
  error.error =
      Error{"registration points lie on a line or in one place (0.123 mm wide, at least " +
            std::string(200, 'x') + ")"};
  error.stroke_next = kFarPlace;
  return {
      Message(std::monostate{}),
      Message(NotPossibleNow{Event::kSayMoveRod}),
      Message(SaidBeforeShown{}),
      Message(NothingToDelete{NothingToDelete::What::kCheckPoint}),
      Message(ConfirmDelete{1234567}),
      Message(refused_for_everything()),
      Message(error),
      Message(ChecksMissing{{Advice::kReject, 20, 0.0200001, 0.02}}),
      Message(ChecksMissing{{Advice::kTouchApart, 2, 0.015, 0.0}}),
      Message(
          TouchNotRecorded{What::kCheckPoint, {TouchRefusal::Kind::kTipMoved, 0.03000001, 0.03}}),
      Message(TouchNotRecorded{What::kLandmark, {TouchRefusal::Kind::kTooNear, 0.022, 0.03}}),
      Message(LandmarkMissing{}),
      Message(LandmarkMoved{0.0123001, 0.0123, false}),
      Message(BoneUnchecked{1234.5, 0.0123}),
      Message(TouchNotRecorded{What::kWire, {TouchRefusal::Kind::kOffTheScrew, 0.12300001, 0.123}}),
      Message(ConfirmRedo{12}),
      Message(NoOtherEntry{}),
      Message(ScrewRedone{0.0123, 0.0123}),
      Message(NoRod{
          refused({"screw heads %zu and %zu are %s apart, limit 5-150 mm",
                   {std::size_t{10}, std::size_t{11}, NearLimit{4.9999, 5.0, "%.4g mm;%.4g"}}})}),
      Message(MapMoved{Step::kDigitize}),
      Message(MapMoved{Step::kRod}),
      Message(NoImages{}),
      Message(NoImages{Repeated::kBothPictures}),
      Message(NoImages{Repeated::kHeadPose}),
      Message(Ended{})};
}

/// Beyond both limits by so little that only decimals show it.
const PlacedWire& far_off() {
  static const PlacedWire kWire = [] {
    PlacedWire wire;
    wire.angle_limit_rad = 12.3 * kRadiansPerDegree;
    wire.entry_limit_m = 0.0123;
    wire.axis.angle_rad = {12.3001 * kRadiansPerDegree, 12.3 * kRadiansPerDegree};
    wire.axis.entry_m = {0.0123001, 0.0123};
    return wire;
  }();
  return kWire;
}

/// At every step, without a warning and with each of them. A message hides how a step stands.
std::vector<StatusLine> lines_about(const Message& message, const Coaching& coaching,
                                    const nav::CheckVerdict& verdict, const HeardCommand& heard) {
  const bool none = std::holds_alternative<std::monostate>(message);
  std::vector<StepState> states = {ChecksSoFar{&verdict}, ChecksSoFar{&verdict, 0.0123}};
  if (none) {
    states.insert(states.end(),
                  {StrokesSoFar{123456, &coaching}, ByEye{}, LandmarkSoFar{false, {}},
                   WireSoFar{&far_off(), true},
                   HeadsSoFar{20, 0.5123, 12, HeadTouch{19, {}, 0.001, 10, 0.00123}, 10}});
  }
  std::vector<StatusLine> lines;
  for (int step = 0; step < static_cast<int>(kStepCount); ++step) {
    for (const StepState& state : states) {
      for (const int warning : {0, 1, 2, 3}) {
        StatusLine line;
        line.at = {static_cast<Step>(step), "L4", Side::kRight};
        line.tool = "reference";
        line.tool_lost = warning == 1;
        if (warning == 2) {
          line.tag_size_off = -0.0321;
        }
        line.pictures_apart = warning == 3;
        line.message = none ? nullptr : &message;
        line.state = state;
        line.heard = &heard;
        line.saved = warning == 0   ? Saved::kSaved
                     : warning == 1 ? Saved::kNotSaved
                                    : Saved::kNotRecorded;
        lines.push_back(line);
      }
    }
  }
  return lines;
}

/// The status line as the scene builder draws it, seen on a display.
GoldenScene drawn(const StatusLine& line, const ShownOn& display) {
  constexpr std::array<ToolDot, 3> kTools = {
      {{ToolState::kMeasured}, {ToolState::kPredicted}, {ToolState::kLost}}};
  GoldenScene golden = golden::start("status", "", display.views);
  golden.width_px = display.width_px;
  golden.height_px = display.height_px;
  std::string detail;
  StatusParts parts;
  append_beside_step(detail, line, &parts);
  add_status_line(golden.scene, StatusWords{step_text(line.at), detail, &parts}, kTools,
                  golden::kStatusLabel);
  return golden;
}

std::string all_text(const GoldenScene& golden) {
  std::string all;
  for (const render::TextItem& item : golden.scene.texts) {
    all += item.runs.front().text + "\n";
  }
  return all;
}

/// Wherever a row ended.
std::string in_one_row(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// Where the step, the dots and every word lie in each view, half a degree from its edges at least.
void expect_inside(const GoldenScene& golden, const ShownOn& display) {
  for (std::size_t view = 0; view < golden.views.size(); ++view) {
    const double across = static_cast<double>(golden.views[view].tan_left) * 2.0;
    const double margin_px = 0.5 * kRadiansPerDegree * display.width_px / across;
    for (const render::TextItem& item : golden.scene.texts) {
      const Box box = box_of_text(golden, item, view);
      const std::string where = display.name + ": " + item.runs.front().text;
      EXPECT_GE(box.left, margin_px) << where;
      EXPECT_LE(box.right, display.width_px - margin_px) << where;
      EXPECT_GE(box.top, margin_px) << where;
      EXPECT_LE(box.bottom, display.height_px - margin_px) << where;
    }
  }
}

/// No text lies over another.
void expect_apart(const GoldenScene& golden) {
  for (std::size_t i = 0; i < golden.scene.texts.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const Box a = box_of_text(golden, golden.scene.texts[i], 0);
      const Box b = box_of_text(golden, golden.scene.texts[k], 0);
      EXPECT_FALSE(a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom)
          << all_text(golden);
    }
  }
}

void expect_whole(const Told& told) {
  Coaching coaching;
  coaching.unique = true;
  coaching.expected_m = 0.0123;
  coaching.against = reason(nav::RefusalReason::Kind::kTre99AtScrews);
  nav::CheckVerdict verdict;
  verdict.advice = {nav::CheckAdvice::Kind::kTouchApart, 2, 0.015, 0.0};
  const HeardCommand heard{"move rod", false};
  const std::vector<ShownOn> on = displays();
  for (const Message& message : messages()) {
    for (const StatusLine& line : lines_about(message, coaching, verdict, heard)) {
      for (const ShownOn& display : on) {
        const GoldenScene golden = drawn(line, display);
        expect_inside(golden, display);
        const std::string text = all_text(golden);
        ASSERT_THAT(text, ::testing::StartsWith(step_text(line.at) + "\n●\n◐\n○\n"));
        if (line.tool_lost) {
          ASSERT_THAT(text, HasSubstr(told.lost));
        }
        if (line.saved == Saved::kNotSaved) {
          ASSERT_THAT(in_one_row(text), HasSubstr(told.not_saved));
        }
        if (const auto* refused = std::get_if<RegistrationRefused>(&message)) {
          ASSERT_TRUE(refused->stroke_next);
          std::string joined = text;
          std::replace(joined.begin(), joined.end(), '\n', ' ');
          ASSERT_THAT(joined, HasSubstr(told.stroke));
        }
      }
      if (::testing::Test::HasFailure()) {
        return;
      }
      if (line.at.step == Step::kDigitize) {
        expect_apart(drawn(line, on.front()));
      }
    }
  }
}

TEST(StatusLineOnDisplays, ShowsTheLongestMessageOfEveryKindWhole) { expect_whole(kEnglish); }

TEST(StatusLineOnDisplays, ShowsItInGermanToo) {
  auto german = tools::language_named("de");
  ASSERT_TRUE(german) << german.error().message;
  const test::LanguageInUse in_use(*std::move(german));
  const WearersLanguage language;
  expect_whole(kGerman);
}

TEST(StatusLineOnDisplays, IsCutWhereNothingShortensIt) {
  // The control that must fail: the whole text on one row.
  const ShownOn display = displays()[1];
  const Message message = refused_for_everything();
  StatusLine line;
  line.at = {Step::kDigitize, "L4", {}};
  line.tool = "reference";
  line.tool_lost = true;
  line.message = &message;
  line.saved = Saved::kNotSaved;
  GoldenScene golden = drawn(line, display);
  render::TextItem& row = golden.scene.texts.back();
  row.runs.front().text = detail_text(line);
  EXPECT_LT(box_of_text(golden, row, 0).left, 0.0);
}

}  // namespace
}  // namespace orthonav::engine
