// The status line, and the target cross with its numbers, go to where both eyes see them whole and
// they cover nothing.
#include "engine/holograms/labels/block_place.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/random.h"
#include "engine/holograms/labels/label_layout.h"
#include "engine/holograms/labels/label_places.h"
#include "engine/holograms/shapes/hologram_label.h"
#include "engine/holograms/shapes/hologram_numbers.h"
#include "engine/holograms/shapes/hologram_status.h"
#include "render/float3.h"
#include "render/frame/frame_items.h"
#include "render/shapes.h"
#include "tests/engine/holograms/operating_field.h"

namespace orthonav::engine::block_place_test {
namespace {

using render::Float3;
using test::OperatingField;
using ::testing::IsEmpty;

constexpr render::Label kCross = label_of(HologramKind::kCross, 1);
constexpr CrossLabels kLabels = {label_of(HologramKind::kAngle, 1),
                                 label_of(HologramKind::kNumbers, 6),
                                 label_of(HologramKind::kDepth, 1)};
constexpr Float3 kEye = {0, 0.45f, 0};
constexpr Float3 kHeadUp = {0, 0, -1};
constexpr Duration kFrame = std::chrono::milliseconds(33);
constexpr float kRounding_m = 1e-5f;
constexpr float kDegree = 3.14159265f / 180.0f;

/// A screw in the origin is being guided: cross, angle, offset, depth; the status line.
OperatingField guided(bool every_number = false, Float3 head_up = kHeadUp) {
  OperatingField field;
  TargetCross cross;
  cross.outward = {0, 1, 0};
  cross.viewer = {kEye, head_up};
  cross.side = LabelSide::kRight;
  cross.reading =
      CrossReading{{0.0022f, 0, 0.0012f}, {0.001f, 0, 0.004f}, Grade::kPoor, Worst::kOffset};
  CrossNumbers numbers;
  numbers.sizes = nav::ScrewSizes{{42, nav::Certainty::kSure}, {25, nav::Certainty::kSure}};
  numbers.depth = nav::ShownDepth{nav::DepthTo::kTarget, 310, nav::Certainty::kSure};
  numbers.way = 0.3f;
  add_target_cross(field.scene, cross, kCross);
  add_cross_numbers(field.scene, cross, numbers, kLabels);
  if (every_number) {
    nav::ScrewNumbers all;
    all.tip_cranial = all.tip_medial = all.aim_cranial = all.aim_medial = {12, 4, true};
    add_numbers(field.scene, cross, all, false, label_of(HologramKind::kNumbers, 1), true);
  }
  const std::array<ToolDot, 2> tools = {{{ToolState::kMeasured}, {ToolState::kMeasured}}};
  add_status_line(field.scene, "guide L5 right | move the tip", tools,
                  label_of(HologramKind::kStatus, 1));
  add_planned_trajectory(field.scene, {}, {0, -0.04f, 0}, label_of(HologramKind::kTrajectory, 1));
  return field;
}

/// Both eyes above the site, which they see so far below and to the left of the middle.
std::vector<render::View> site_at(float below_deg, float left_deg = 0, float roll_rad = 0) {
  const Float3 ahead = {std::tan(left_deg * kDegree), -1, -std::tan(below_deg * kDegree)};
  const Float3 up = {std::sin(roll_rad), 0, -std::cos(roll_rad)};
  return render::stereo_pair(render::look_at(kEye, kEye + ahead, up, 0.394f, 0.2561f));
}

bool of_block(render::Label label) {
  const HologramKind kind = kind_of(label);
  return kind == HologramKind::kCross || kind == HologramKind::kAngle ||
         kind == HologramKind::kDepth || kind == HologramKind::kNumbers;
}

/// The texts of the block that an edge of a view cuts, or comes nearer to than a digit.
std::size_t cut_texts(const render::Scene& scene, const std::vector<render::View>& views) {
  constexpr float kDigit = 0.006f;
  static const render::Font font;
  const Eyes eyes(views);
  return static_cast<std::size_t>(
      std::count_if(scene.texts.begin(), scene.texts.end(), [&](const render::TextItem& text) {
        LabelExtent extent;
        extent.width = render::line_width(font, text);
        return text.place == render::TextPlace::kWorld && of_block(text.label) &&
               !eyes.in_view(grown(eyes.box(render::world_from_caps(text, eyes.head()),
                                            box_at(place_of(text, extent, 0), extent)),
                                   kDigit));
      }));
}

std::size_t block_texts(const render::Scene& scene) {
  return static_cast<std::size_t>(
      std::count_if(scene.texts.begin(), scene.texts.end(), [](const render::TextItem& text) {
        return text.place == render::TextPlace::kWorld && of_block(text.label);
      }));
}

OperatingField laid_out(OperatingField field, const std::vector<render::View>& views) {
  LabelLayout().lay_out(field.scene, views, field.papers, Timestamp{});
  return field;
}

/// Where the cross is after one more frame.
class Frames {
 public:
  Float3 next(const std::vector<render::View>& views) {
    OperatingField field = guided();
    layout_.lay_out(field.scene, views, {}, Timestamp{} + ++frame_ * kFrame);
    return disc_of(field.scene, kCross)->middle;
  }

 private:
  LabelLayout layout_;
  int frame_ = 0;
};

constexpr float kClear_deg = -1.0f;
constexpr float kInTheWay_deg = -9.0f;  // the block would be cut above

Float3 as_built() { return disc_of(guided().scene, kCross)->middle; }

TEST(BlockPlace, LeavesABlockThatIsInNobodysWay) {
  const OperatingField field = laid_out(guided(), site_at(kClear_deg));
  EXPECT_EQ(field.scene.texts, guided().scene.texts);
  EXPECT_EQ(disc_of(field.scene, kCross)->middle, as_built());
}

TEST(BlockPlace, IsWholeInBothEyesWhereverTheSiteIsInView) {
  std::size_t cut_before = 0;
  std::size_t faults_before = 0;
  for (float below_deg = -12; below_deg <= 12; below_deg += 2.0f) {
    for (float left_deg = -18; left_deg <= 18; left_deg += 4.0f) {
      for (const float roll_rad : {-0.2f, 0.0f, 0.2f}) {
        const auto views = site_at(below_deg, left_deg, roll_rad);
        const OperatingField built = guided(false, render::head_of(views).up);
        cut_before += cut_texts(built.scene, views);
        faults_before += test::faults(built, views).size();
        const OperatingField field = laid_out(built, views);
        EXPECT_EQ(cut_texts(field.scene, views), 0u) << below_deg << " " << left_deg;
        EXPECT_EQ(block_texts(field.scene), 3u) << below_deg << " " << left_deg;
        EXPECT_THAT(test::faults(field, views), IsEmpty()) << below_deg << " " << left_deg;
      }
    }
  }
  EXPECT_GT(cut_before, 0u) << "nothing would be cut here";
  EXPECT_GT(faults_before, 0u) << "nothing is in the way here";
}

TEST(BlockPlace, GoesOffPaperAndOffTheTrajectory) {
  const auto views = site_at(kClear_deg);
  OperatingField field = guided();
  const Float3 middle = as_built();
  constexpr float kHalf_m = 0.03f;
  field.papers.push_back(
      {middle + Float3{-kHalf_m, 0, -kHalf_m}, middle + Float3{kHalf_m, 0, -kHalf_m},
       middle + Float3{kHalf_m, 0, kHalf_m}, middle + Float3{-kHalf_m, 0, kHalf_m}});
  EXPECT_FALSE(test::faults(field, views).empty()) << "as built it is on it";
  EXPECT_THAT(test::faults(laid_out(field, views), views), IsEmpty());
  OperatingField crossed = guided();
  add_planned_trajectory(crossed.scene, middle + Float3{0, 0, 0.04f}, middle + Float3{0, 0, -0.04f},
                         label_of(HologramKind::kTrajectory, 1));
  EXPECT_GT(render::length(disc_of(laid_out(crossed, views).scene, kCross)->middle - middle),
            kCrossScale * kCrossRings_m.back())
      << "aside by more than its rings";
}

TEST(BlockPlace, IsLeftOutRatherThanCutAndWhatWasAskedForFirst) {
  const auto far = site_at(0, 60);
  ASSERT_GT(cut_texts(guided().scene, far), 0u);
  const OperatingField gone = laid_out(guided(), far);
  EXPECT_EQ(block_texts(gone.scene), 0u);
  EXPECT_FALSE(disc_of(gone.scene, kCross));
  // A window just wide enough for the three numbers.
  auto narrow = site_at(-4, -8);
  for (render::View& view : narrow) {
    view.tan_left = view.tan_right = 0.20f;
    view.tan_up = view.tan_down = 0.135f;
  }
  const OperatingField few = laid_out(guided(true), narrow);
  EXPECT_EQ(block_texts(few.scene), 3u) << "of " << block_texts(guided(true).scene);
  EXPECT_EQ(cut_texts(few.scene, narrow), 0u);
}

TEST(BlockPlace, TurnsTheWholeBlockAboutTheEyes) {
  const OperatingField built = guided();
  const auto views = site_at(kInTheWay_deg);
  const OperatingField field = laid_out(guided(), views);
  const Float3 eyes = render::head_of(views).position;
  const Float3 middle = disc_of(field.scene, kCross)->middle;
  EXPECT_GT(render::length(middle - as_built()), 0.005f);
  const auto stays = [&](Float3 before, Float3 after) {
    EXPECT_NEAR(render::length(after - eyes), render::length(before - eyes), kRounding_m);
    EXPECT_NEAR(render::length(after - middle), render::length(before - as_built()), kRounding_m);
  };
  for (std::size_t i = 0; i < built.scene.texts.size(); ++i) {
    const render::TextItem& text = built.scene.texts[i];
    if (text.place == render::TextPlace::kWorld) {
      stays(text.position, field.scene.texts[i].position);
    }
  }
  for (std::size_t i = 0; i < built.scene.lines.size(); ++i) {
    if (of_block(built.scene.lines[i].label)) {
      stays(built.scene.lines[i].points.front(), field.scene.lines[i].points.front());
    }
  }
  ASSERT_FALSE(built.scene.meshes.empty()) << "the dot of the tip";
  const auto place = [](const OperatingField& of) {
    const render::Matrix4& m = of.scene.meshes[0].world_from_model;
    return Float3(m[3]);
  };
  stays(place(built), place(field));
}

TEST(BlockPlace, LeavesAtOnceAndComesBackAfterASecondOfRoom) {
  Frames frames;
  EXPECT_EQ(frames.next(site_at(kClear_deg)), as_built());
  EXPECT_NE(frames.next(site_at(kInTheWay_deg)), as_built());
  const int frames_of_a_second = static_cast<int>(LabelLayout::kSettled / kFrame);
  for (int i = 0; i < frames_of_a_second; ++i) {
    frames.next(site_at(kClear_deg));
  }
  frames.next(site_at(kClear_deg));
  frames.next(site_at(kClear_deg));
  EXPECT_EQ(frames.next(site_at(kClear_deg)), as_built());
}

TEST(BlockPlace, DoesNotFollowATremblingHead) {
  constexpr double kTremble_deg = 0.1;
  for (float below_deg = -10; below_deg <= 12; below_deg += 1.0f) {
    Random random(5);
    Frames frames;
    int moves = 0;
    std::optional<Float3> before;
    for (int i = 0; i < 150; ++i) {
      const Float3 now = frames.next(
          site_at(below_deg + static_cast<float>(random.normal(0, kTremble_deg)), 5.0f));
      moves += before && render::length(now - *before) > 0.002f ? 1 : 0;
      before = now;
    }
    // A place at the edge of what is free may be left, once.
    EXPECT_LE(moves, 1) << below_deg;
  }
}

/// A tag's paper of 60 mm about the place where the head carries the status line, as far as the
/// bone.
GlarePatch paper_behind_status(const std::vector<render::View>& views) {
  const render::Head head = render::head_of(views);
  const Float3 middle =
      head.position + 0.85f * (kStatusPlace.y * head.up + kStatusPlace.z * head.back);
  const Float3 across = 0.030f * head.right;
  const Float3 along = 0.030f * head.up;
  return {middle + -1.0f * across + -1.0f * along, middle + across + -1.0f * along,
          middle + across + along, middle + -1.0f * across + along};
}

/// Where the rows of the status line hang on the head: all in one place.
Float3 hung(const render::Scene& scene) {
  std::optional<Float3> place;
  for (const render::TextItem& text : scene.texts) {
    if (text.place == render::TextPlace::kView) {
      EXPECT_EQ(place.value_or(text.position), text.position);
      place = text.position;
    }
  }
  return place.value_or(Float3{});
}

TEST(StatusPlace, StaysWhereNothingIsInItsWay) {
  EXPECT_EQ(hung(laid_out(guided(), site_at(kClear_deg)).scene), kStatusPlace);
}

TEST(StatusPlace, MakesWayForTheReferencesTag) {
  for (float below_deg = -6; below_deg <= 8; below_deg += 2.0f) {
    const auto views = site_at(below_deg);
    OperatingField field = guided(false, render::head_of(views).up);
    field.papers.push_back(paper_behind_status(views));
    EXPECT_THAT(test::faults(field, views), ::testing::Not(IsEmpty())) << "as built it is on it";
    const OperatingField off = laid_out(field, views);
    EXPECT_THAT(test::faults(off, views), IsEmpty()) << below_deg;
    EXPECT_NEAR(render::length(hung(off.scene)), render::length(kStatusPlace), kRounding_m)
        << "as large as before";
    EXPECT_EQ(block_texts(off.scene), 3u);
  }
}

TEST(StatusPlace, MakesWayForTheSite) {
  const auto views = site_at(11);  // the entry under the status line
  const auto covers = [&](const OperatingField& field) {
    const Eyes eyes(views);
    const BoxInEyes entry = eyes.box(std::array<Float3, 4>{});
    static const render::Font font;
    return std::any_of(
        field.scene.texts.begin(), field.scene.texts.end(), [&](const render::TextItem& text) {
          LabelExtent extent;
          extent.width = render::line_width(font, text);
          return text.place == render::TextPlace::kView &&
                 overlap(grown(entry, 0.012f), eyes.box(render::world_from_caps(text, eyes.head()),
                                                        box_at(place_of(text, extent, 0), extent)));
        });
  };
  const OperatingField built = guided(false, render::head_of(views).up);
  ASSERT_TRUE(covers(built));
  EXPECT_FALSE(covers(laid_out(built, views)));
}

/// No screw is guided, so that no trajectory tells where the wound is: strokes over a bone about
/// the origin, or the entries of a level.
enum class Told { kByStrokes, kByEntries, kNot };
OperatingField open_wound(Told told) {
  OperatingField field;
  const std::array<ToolDot, 2> tools = {{{ToolState::kMeasured}, {ToolState::kMeasured}}};
  add_status_line(field.scene, "digitize L4 | stroke the left lamina", tools,
                  label_of(HologramKind::kStatus, 1));
  for (const float aside_m : {-0.015f, 0.015f}) {
    const std::array<Float3, 2> along = {{{aside_m, 0, -0.01f}, {aside_m, 0, 0.01f}}};
    if (told == Told::kByStrokes) {
      field.scene.lines.push_back({label_of(HologramKind::kPath, 1), {}, 0.001f, {}, false, 0});
      field.scene.lines.back().points.assign(along.begin(), along.end());
    } else if (told == Told::kByEntries) {
      field.scene.meshes.push_back({});
      field.scene.meshes.back().label = label_of(HologramKind::kEntry, 1);
      field.scene.meshes.back().world_from_model = render::placed_at({aside_m, 0, 0}, 0.002f);
    }
  }
  return field;
}

TEST(StatusPlace, MakesWayForTheWoundThatStrokesOrEntriesShow) {
  const auto views = site_at(11);
  const auto lies_over_it = [&](Told told) {
    OperatingField field = laid_out(open_wound(told), views);
    const Eyes eyes(views);
    static const render::Font font;
    const std::array<Float3, 1> middle{};
    return std::any_of(field.scene.texts.begin(), field.scene.texts.end(), [&](const auto& text) {
      LabelExtent extent;
      extent.width = render::line_width(font, text);
      return text.place == render::TextPlace::kView &&
             overlap(eyes.outline(middle, 0.015f),
                     eyes.box(render::world_from_caps(text, eyes.head()),
                              box_at(place_of(text, extent, 0), extent)));
    });
  };
  EXPECT_FALSE(lies_over_it(Told::kByStrokes));
  EXPECT_FALSE(lies_over_it(Told::kByEntries));
  EXPECT_TRUE(lies_over_it(Told::kNot)) << "else it proves nothing";
}

TEST(StatusPlace, LeavesAtOnceAndComesBackAfterASecondOfRoom) {
  const auto views = site_at(kClear_deg);
  LabelLayout layout;
  int frame = 0;
  const auto next = [&](bool paper) {
    OperatingField field = guided();
    if (paper) {
      field.papers.push_back(paper_behind_status(views));
    }
    layout.lay_out(field.scene, views, field.papers, Timestamp{} + ++frame * kFrame);
    return hung(field.scene);
  };
  EXPECT_EQ(next(false), kStatusPlace);
  const Float3 aside = next(true);
  EXPECT_NE(aside, kStatusPlace);
  const int frames_of_a_second = static_cast<int>(LabelLayout::kSettled / kFrame);
  for (int i = 0; i < frames_of_a_second; ++i) {
    EXPECT_EQ(next(false), aside) << i;
  }
  next(false);
  next(false);
  EXPECT_EQ(next(false), kStatusPlace);
}

TEST(PointToEntry, ShowsTheWayWhereTheEntryIsOutOfView) {
  const auto arrow_of = [](const std::vector<render::View>& views) {
    OperatingField field = guided();
    const std::size_t before = field.scene.triangles.size();
    point_to_entry(field.scene, Eyes(views));
    return field.scene.triangles.size() > before
               ? std::optional(field.scene.triangles.back().corners)
               : std::nullopt;
  };
  EXPECT_FALSE(arrow_of(site_at(0)));
  for (const float left_deg : {-40.0f, 40.0f, 120.0f}) {
    const auto views = site_at(3, left_deg);
    const auto arrow = arrow_of(views);
    ASSERT_TRUE(arrow) << left_deg;
    const Eyes eyes(views);
    for (const Float3 corner : *arrow) {
      EXPECT_TRUE(eyes.in_view(corner)) << left_deg;
    }
    // Its tip is nearer to the entry than its foot, as the head sees it.
    const float towards = dot((*arrow)[0] - (*arrow)[1], eyes.head().right);
    EXPECT_GT(towards * dot(-1.0f * kEye, eyes.head().right), 0.0f) << left_deg;
  }
}

}  // namespace
}  // namespace orthonav::engine::block_place_test
