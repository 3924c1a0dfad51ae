#include "engine/holograms/hologram_numbers.h"

#include "engine/holograms/hologram_parts.h"
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
/// Of what is not sure, and of the words beside the numbers. A paler text alone would not do: by
/// the contrast that every text needs it is hardly paler.
constexpr float kSmaller = 0.8f;
constexpr float kRow_caps = 1.7f;
/// From the rim of the cross down to the first row's baseline.
constexpr float kBelowRim_caps = 2.2f;
/// The words "tip" and "aims" end left of the middle of the cross, the numbers begin there.
constexpr float kColumn_caps = 3.0f;
constexpr float kBetweenColumns_caps = 0.6f;

/// Where the rows of a block hang, in cap heights of its numbers from one place.
class Block {
 public:
  Block(Scene& scene, Float3 place, Label label) : scene_(scene), place_(place), label_(label) {}

  void next_row() { up_ -= kRow_caps; }
  void heading(std::string_view words) {
    add(TextAlign::kRight, -kColumn_caps - kBetweenColumns_caps, false) = words;
  }
  std::string& text(bool sure) { return add(TextAlign::kLeft, -kColumn_caps, sure); }

 private:
  std::string& add(TextAlign align, float right, bool sure) {
    const float size = sure ? 1.0f : kSmaller;
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
  Float3 place_;
  Label label_;
  float up_ = -kBelowRim_caps;
};

}  // namespace

void add_numbers(Scene& scene, const TargetCross& cross, const nav::ScrewNumbers& numbers,
                 bool registration_only, Label label) {
  const CrossPlaces places = places_of(cross);
  const Float3 rim = places.middle - kCrossScale * kCrossRings_m.back() * places.up;
  Block block(scene, rim, label);
  for (std::size_t i = 0; i < kNumberRows; ++i) {
    const auto row = static_cast<NumberRow>(i);
    if (row == NumberRow::kTipCranial) {
      block.heading(words::kTip);
    } else if (row == NumberRow::kAimCranial) {
      block.heading(words::kAims);
    }
    append_number(block.text(number_of(numbers, row).sure), numbers, row);
    block.next_row();
  }
  if (registration_only && !all_sure(numbers)) {
    block.text(false) = words::kSdOfRegistrationOnly;
  }
}

}  // namespace orthonav::engine
