#pragma once

#include <map>
#include <utility>

#include "engine/live/bone_lines.h"
#include "hal/api/object_display.h"
#include "render/projection.h"
#include "render/text/font.h"

namespace orthonav::engine {

/// Adds objects to a list, each with a key that stays the same from list to list: the hologram's
/// label, the kind of part, and its number among these.
class ObjectWriter {
 public:
  /// The kind of object; part of its key.
  enum class Part : std::uint8_t { kBall, kPiece, kText, kBar };

  /// Appends to `list` from now on; its content stays.
  void begin(ObjectList& list);
  /// Objects added from now on have this label.
  void label(render::Label label);
  /// A ball, or a cube on its corner, by its radius.
  void add_ball(render::Float3 centre, float radius_m, render::Colour colour, ObjectShape shape);
  /// A round piece, from one end to the other.
  void add_piece(const StraightPiece& piece, float width_m, render::Colour colour);
  /// A line of text facing the head; a rim becomes bars in its colour above and below.
  void add_text(const render::TextItem& item, const render::Head& head);
  /// Forgets texts that were not written since the last call.
  void end();

 private:
  /// A text's pose when it was last sent: texts do not follow small motions of the head.
  struct Lying {
    Vec3 position_m{};
    Quaternion rotation{};
    double cap_height_m = 0;
    bool used = true;
  };
  DisplayObject& add(Part part, ObjectShape shape, render::Colour colour);
  void add_bars(const render::TextItem& item, const Lying& lying, double half_width_caps);
  void steady(std::uint64_t key, Lying& lying);

  ObjectList* list_ = nullptr;
  render::Label label_ = 0;
  bool of_tool_ = false;
  ObjectPlace place_ = ObjectPlace::kWorld;
  std::map<std::pair<render::Label, Part>, std::uint32_t> counts_;
  std::map<std::uint64_t, Lying> lying_;
  render::Font font_;
};

}  // namespace orthonav::engine
