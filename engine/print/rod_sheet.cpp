#include "engine/print/rod_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/angle.h"
#include "base/printed.h"

namespace orthonav::engine {
namespace {

constexpr double kRodTextMm = 3.2;
constexpr double kRodLineMm = 5.5;
constexpr double kRodRowMm = 17.0;
constexpr double kDialMm = 4.0;  ///< radius
constexpr double kRodGapMm = 6.0;
constexpr double kHalfRodMm = 2.75;
/// Places of the table's columns, from the left of the page's content.
constexpr std::array<double, 7> kColumnsMm = {0, 14, 48, 74, 100, 130, 160};

/// Fills the page from top to bottom.
class RodPage {
 public:
  RodPage(Sheet& sheet, const SheetRect& content) : sheet_(sheet), content_(content) {}

  void text(double x_mm, double y_mm, const std::string& text,
            SheetAlign align = SheetAlign::kLeft) {
    sheet_.texts.push_back({content_.x_mm + x_mm, y_mm, kRodTextMm, text, align});
  }
  void line(Vec2 from_mm, Vec2 to_mm, double width_mm = 0.2) {
    sheet_.lines.push_back(
        {content_.x_mm + from_mm.x, from_mm.y, content_.x_mm + to_mm.x, to_mm.y, width_mm});
  }
  void say(const std::string& what) {
    y_mm_ += kRodLineMm;
    text(0.0, content_.y_mm + y_mm_, what);
  }
  void skip(double mm) { y_mm_ += mm; }
  [[nodiscard]] double y_mm() const { return content_.y_mm + y_mm_; }
  [[nodiscard]] double width_mm() const { return content_.width_mm; }
  [[nodiscard]] bool fits() const { return y_mm_ <= content_.height_mm; }
  [[nodiscard]] double taken_mm() const { return y_mm_; }

 private:
  Sheet& sheet_;
  SheetRect content_;
  double y_mm_ = 0.0;
};

/// As the rod is seen from its first end: the drawn line above, the roll clockwise.
void add_dial(RodPage& page, Vec2 centre_mm, double roll_rad) {
  constexpr int kSides = 36;
  for (int i = 0; i < kSides; ++i) {
    const double a = 2.0 * std::numbers::pi * i / kSides;
    const double b = 2.0 * std::numbers::pi * (i + 1) / kSides;
    page.line(centre_mm + kDialMm * Vec2{std::sin(a), -std::cos(a)},
              centre_mm + kDialMm * Vec2{std::sin(b), -std::cos(b)});
  }
  page.line(centre_mm + Vec2{0, -kDialMm}, centre_mm + Vec2{0, -kDialMm - 1.5}, 0.5);
  page.line(centre_mm, centre_mm + kDialMm * Vec2{std::sin(roll_rad), -std::cos(roll_rad)}, 0.6);
}

void add_table(RodPage& page, const nav::RodInstructions& told) {
  constexpr std::array<const char*, 7> kHeads = {"bend",          "middle at", "roll", "angle",
                                                 "set bender to", "radius",    "made"};
  page.skip(3.0);
  page.say("");
  for (std::size_t c = 0; c < kHeads.size(); ++c) {
    page.text(kColumnsMm[c], page.y_mm(), kHeads[c]);
  }
  page.line({0, page.y_mm() + 1.5}, {page.width_mm(), page.y_mm() + 1.5});
  for (std::size_t k = 0; k < told.bends.size(); ++k) {
    const nav::RodInstruction& bend = told.bends[k];
    page.skip(2.0 * kDialMm + 3.0 - kRodLineMm);
    page.say(printed("%zu", k + 1));
    page.text(kColumnsMm[1], page.y_mm(), printed("%.1f mm", bend.arc.centre_m * 1e3));
    page.text(kColumnsMm[2], page.y_mm(), printed("%.0f°", bend.arc.roll_rad * kDegreesPerRadian));
    add_dial(page, {kColumnsMm[2] + 16.0, page.y_mm() - 1.1}, bend.arc.roll_rad);
    page.text(kColumnsMm[3], page.y_mm(), printed("%.1f°", bend.arc.angle_rad * kDegreesPerRadian));
    page.text(kColumnsMm[4], page.y_mm(), printed("%.1f°", bend.set_rad * kDegreesPerRadian));
    page.text(kColumnsMm[5], page.y_mm(),
              printed("%.0f mm", bend.arc.width_m / std::max(bend.arc.angle_rad, 1e-3) * 1e3));
  }
  page.skip(kDialMm);
}

/// The straight rod with its bends, in as many rows as needed.
void add_straight_rod(RodPage& page, const nav::RodInstructions& told) {
  const double length_mm = told.cut_length_m() * 1e3;
  const double row_mm = 10.0 * std::floor(page.width_mm() / 10.0);
  page.say("The straight rod 1:1, first end on the left; middle and both edges of each bend:");
  for (double from_mm = 0.0; from_mm < length_mm; from_mm += row_mm) {
    const double to_mm = std::min(length_mm, from_mm + row_mm);
    page.skip(kRodRowMm);
    const double y_mm = page.y_mm() - 7.0;
    page.line({0, y_mm - kHalfRodMm}, {to_mm - from_mm, y_mm - kHalfRodMm});
    page.line({0, y_mm + kHalfRodMm}, {to_mm - from_mm, y_mm + kHalfRodMm});
    page.line({0, y_mm - 4}, {0, y_mm + 4}, from_mm == 0.0 ? 0.6 : 0.2);
    page.line({to_mm - from_mm, y_mm - 4}, {to_mm - from_mm, y_mm + 4},
              to_mm == length_mm ? 0.6 : 0.2);
    page.text(0, y_mm + 7, printed("%.1f mm", from_mm));
    page.text(to_mm - from_mm, y_mm + 7, printed("%.1f mm", to_mm), SheetAlign::kRight);
    for (std::size_t k = 0; k < told.bends.size(); ++k) {
      const nav::RodArc& arc = told.bends[k].arc;
      for (const double beside : {-0.5, 0.0, 0.5}) {
        const double at_mm = (arc.centre_m + beside * arc.width_m) * 1e3;
        if (at_mm >= from_mm && at_mm < to_mm) {
          page.line({at_mm - from_mm, y_mm - (beside == 0.0 ? 5.0 : kHalfRodMm)},
                    {at_mm - from_mm, y_mm + kHalfRodMm}, beside == 0.0 ? 0.5 : 0.2);
        }
        if (beside == 0.0 && at_mm >= from_mm && at_mm < to_mm) {
          page.text(at_mm - from_mm, y_mm - 5.8, printed("%zu", k + 1), SheetAlign::kCentre);
        }
      }
    }
  }
}

struct RodView {
  const char* name;
  Vec3 up;  ///< in the rod's frame
};

/// The finished rod from one side, its first end on the left, its chord along the page.
void add_view(RodPage& page, const std::vector<Vec3>& axis_m, const RodView& view) {
  std::vector<Vec2> flat_mm;
  for (const Vec3& at_m : axis_m) {
    flat_mm.push_back({at_m.z * 1e3, -at_m.dot(view.up) * 1e3});
  }
  const Vec2 chord = flat_mm.back() - flat_mm.front();
  const double cosine = chord.x / chord.norm();
  const double sine = chord.y / chord.norm();
  for (Vec2& p : flat_mm) {
    p = {cosine * p.x + sine * p.y, -sine * p.x + cosine * p.y};
  }
  const auto [top, bottom] = std::minmax_element(
      flat_mm.begin(), flat_mm.end(), [](const Vec2& a, const Vec2& b) { return a.y < b.y; });
  const double above_mm = top->y;
  const double below_mm = bottom->y;
  page.skip(kRodGapMm);
  page.say(view.name);
  page.skip(kRodGapMm - above_mm);
  const double y_mm = page.y_mm();
  for (std::size_t i = 1; i < flat_mm.size(); ++i) {
    page.line(flat_mm[i - 1] + Vec2{0, y_mm}, flat_mm[i] + Vec2{0, y_mm}, 0.5);
  }
  for (const Vec2& end : {flat_mm.front(), flat_mm.back()}) {
    page.line(end + Vec2{0, y_mm - 2.0}, end + Vec2{0, y_mm + 2.0}, 0.3);
  }
  page.skip(below_mm);
}

}  // namespace

Result<Sheet> rod_sheet(const nav::RodInstructions& told, const RodSheetNotes& notes,
                        const Page& paper) {
  Sheet sheet = blank_sheet(paper);
  add_heading(sheet, "orthonav rod" + (notes.title.empty() ? "" : ", " + notes.title));
  const SheetRect content = content_of(paper);
  RodPage page(sheet, content);
  page.say(
      printed("%s, %.1f mm; bender: %.0f mm of the rod curved by a bend, no radius below %.1f "
              "mm",
              notes.material.c_str(), notes.diameter_m * 1e3, notes.bender_width_m * 1e3,
              notes.smallest_radius_m * 1e3));
  page.say(
      printed("Cut to %.1f mm. Draw a line along the rod. Bend in this order, each bend once; "
              "none is bent back.",
              told.cut_length_m() * 1e3));
  page.say("Roll: seen from the first end, clockwise from the line; the far end goes there.");
  add_table(page, told);
  add_straight_rod(page, told);
  const std::vector<Vec3> axis_m = nav::rod_axis(told.fit.arcs, told.cut_length_m());
  const double chord_mm = (axis_m.back() - axis_m.front()).norm() * 1e3;
  if (chord_mm <= page.width_mm()) {
    add_view(page, axis_m, {"The bent rod's axis 1:1, the drawn line above:", {1, 0, 0}});
    add_view(page, axis_m, {"The same from above, the drawn line towards you:", {0, -1, 0}});
  }
  if (!page.fits() || kColumnsMm.back() + 12.0 > content.width_mm) {
    return Error{
        printed("rod instructions with %zu bends take %s x %s mm, page %s has room for %s "
                "x %s mm",
                told.bends.size(), mm_text(kColumnsMm.back() + 12.0).c_str(),
                mm_text(page.taken_mm()).c_str(), paper.name.c_str(),
                mm_text(content.width_mm).c_str(), mm_text(content.height_mm).c_str())};
  }
  return sheet;
}

}  // namespace orthonav::engine
