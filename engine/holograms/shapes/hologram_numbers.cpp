#include "engine/holograms/shapes/hologram_numbers.h"

#include "base/translation.h"
#include "engine/holograms/shapes/hologram_parts.h"
#include "render/float3.h"

namespace orthonav::engine {
namespace {

using render::Float3;
using render::Label;
using render::Scene;
using render::TextAlign;
using render::TextItem;

constexpr float kCaps_m = 0.0040f;
constexpr float kLeastCaps_deg = 0.55f;
constexpr float kRow_caps = 1.7f;
/// From the rim of the cross down to the first row's baseline, below angle, offset and depth.
constexpr float kBelowRim_caps = 9.6f;
/// Text keeps its visual angle, so it grows in the world with the distance; it grows away from the
/// site, starting at the edge of the cross that is nearer to it. This is the width from there to
/// where the numbers begin: the largest width of the numbers, or of the words before them.
constexpr float kNumbersWidth_caps = 9.0f;
constexpr float kHeadingsWidth_caps = 5.2f;
constexpr float kNearerToSite_m = 0.004f;
constexpr float kBetweenColumns_caps = 0.6f;

/// Below the numbers and the remark on their SDs.
constexpr float kClearanceAfter_rows = 5.1f;

/// Places the rows of a block, in cap heights of its numbers from one place.
class Block {
 public:
  Block(Scene& scene, const TargetCross& cross, Label label) : scene_(scene), label_(label) {
    const CrossPlaces places = places_of(cross);
    const float rim_m = kCrossScale * kCrossRings_m.back();
    left_of_site_ = cross.side == LabelSide::kLeft;
    const float aside_m = rim_m + kNearerToSite_m;
    place_ =
        places.middle - rim_m * places.up + (left_of_site_ ? aside_m : -aside_m) * places.right;
    column_ = left_of_site_ ? -kNumbersWidth_caps : kHeadingsWidth_caps + kBetweenColumns_caps;
  }

  void next_row() { up_ -= kRow_caps; }
  void skip(float rows) { up_ -= rows * kRow_caps; }
  void heading(std::string_view words) {
    add(TextAlign::kRight, column_ - kBetweenColumns_caps, false) = words;
  }
  /// A long text, therefore smaller; white with a red rim.
  std::string& warning() {
    std::string& text = add(left_of_site_ ? TextAlign::kRight : TextAlign::kLeft, 0, false);
    scene_.texts.back().rim = look::colours().poor;
    scene_.texts.back().runs.front().colour = look::kWhite;
    return text;
  }
  std::string& text(bool sure) { return add(TextAlign::kLeft, column_, sure); }

 private:
  std::string& add(TextAlign align, float right, bool sure) {
    const float size = sure ? 1.0f : kUnsureSize;
    TextItem& item = scene_.texts.emplace_back();
    item.label = label_;
    item.position = place_;
    item.align = align;
    item.offset_right = right / size;
    item.offset_up = up_ / size;
    item.height_m = size * kCaps_m;
    item.min_height_deg = size * kLeastCaps_deg;
    return add_run(item, sure ? look::kWhite : look::kPale);
  }

  Scene& scene_;
  Float3 place_{};
  Label label_;
  bool left_of_site_ = true;
  float column_ = 0;
  float up_ = -kBelowRim_caps;
};

}  // namespace

void add_numbers(Scene& scene, const TargetCross& cross, const nav::ScrewNumbers& numbers,
                 bool registration_only, Label label, bool with_bound) {
  Block block(scene, cross, label);
  for (std::size_t i = 0; i < kNumberRows; ++i) {
    const auto row = static_cast<NumberRow>(i);
    if (row == NumberRow::kTipCranial) {
      block.heading(translated(words::kTip));
    } else if (row == NumberRow::kAimCranial) {
      block.heading(translated(words::kAims));
    }
    append_number(block.text(number_of(numbers, row).sure), numbers, row);
    block.next_row();
  }
  if (registration_only && (with_bound || !all_sure(numbers))) {
    block.text(false) = translated(words::kSdOfRegistrationOnly);
  }
}

void add_clearance(Scene& scene, const TargetCross& cross, const nav::ShownClearance& clearance,
                   Label label) {
  Block block(scene, cross, label);
  block.skip(kClearanceAfter_rows);
  block.heading(translated(words::kClearance));
  append_clearance(block.text(true), clearance.least_tenths);
  block.next_row();
  if (clearance.may_break()) {
    append_breach(block.warning(), clearance);
  } else if (clearance.lower_95_tenths) {
    block.heading(translated(words::kAtLeast));
    append_clearance(block.text(true), *clearance.lower_95_tenths);
  }
}

}  // namespace orthonav::engine
