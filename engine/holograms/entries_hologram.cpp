#include "engine/holograms/hologram.h"

#include "engine/holograms/shapes/render_values.h"
#include "engine/session/text/wording.h"

namespace orthonav::engine {
namespace {

/// The name of a screw where it stands at its entry: the side, with its level if the status line
/// does not say that.
void append_entry_name(std::string& out, const Visibility& visible, const PlacedLevel& at,
                       std::size_t screw) {
  const auto& selected = visible.trajectory;
  const bool is_selected = selected && selected->at.level == at.level && selected->screw == screw;
  if (!visible.entry_labels || at.level->screws[screw].done ||
      (visible.only_selected_named && !is_selected)) {
    return;
  }
  const Side side = at.level->plan.screws[screw].side;
  if (at.level == visible.level) {
    out += word_of(side);
  } else {
    append_screw(out, at.level->plan.label, side);
  }
}

/// H3.
class Entries : public Hologram {
 public:
  void draw(const Guidance& /*guidance*/, const Visibility& visible,
            render::Scene& scene) override {
    std::size_t k = 0;
    for (const PlacedLevel& at : visible.entries_of) {
      const LevelState& level = *at.level;
      const auto& world_from_vertebra = at.world_from_vertebra;
      for (std::size_t s = 0; s < level.plan.screws.size(); ++s) {
        const nav::ScrewPlan& screw = level.plan.screws[s];
        const auto on_bone = level.plan.model->surface().nearest(screw.entry.v);
        const Vec3 outward = on_bone ? on_bone->normal : (screw.entry - screw.target);
        EntryHologram entry;
        entry.position = to_float3((world_from_vertebra * screw.entry).v);
        entry.surface_normal =
            to_float3((world_from_vertebra * Direction<Vertebra>{outward.normalized()}).v);
        text_.clear();
        append_entry_name(text_, visible, at, s);
        entry.text = text_;
        entry.done = level.screws[s].done;
        // From behind, where the surgeon looks from, the patient's left is on the left.
        entry.side = screw.side == nav::Side::kLeft ? LabelSide::kLeft : LabelSide::kRight;
        add_entry(scene, entry, label_of(HologramKind::kEntry, ++k));
      }
    }
  }

  void tell(const Guidance& /*guidance*/, const Visibility& visible,
            ShownHolograms& told) override {
    for (const PlacedLevel& at : visible.entries_of) {
      const OperatedLevel& plan = at.level->plan;
      for (const nav::ScrewPlan& screw : plan.screws) {
        ShownHologram& entry = told.add(HologramKind::kEntry);
        entry.level = plan.label;
        entry.side = screw.side;
        append_entry_name(entry.text, visible, at,
                          static_cast<std::size_t>(&screw - plan.screws.data()));
        entry.points_in_world.push_back(at.world_from_vertebra * screw.entry);
      }
    }
  }

 private:
  std::string text_;
};

}  // namespace

std::unique_ptr<Hologram> entries_hologram() { return std::make_unique<Entries>(); }

}  // namespace orthonav::engine
