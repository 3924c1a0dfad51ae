#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <string>

#include "engine/holograms/visibility.h"
#include "engine/session/shown_frame.h"

namespace orthonav::engine {

/// Describes a frame in words and points: what a person wearing the display reads off it. Reuses
/// the frame's buffers; in the steady state it allocates nothing.
class ShownFrameWriter {
 public:
  void write(const Guidance& guidance, const Visibility& visible, ShownFrame& frame);

 private:
  ShownHologram& add(ShownFrame& frame, HologramKind kind);
  void write_path(const Guidance& guidance, const Visibility& visible, ShownFrame& frame);
  void write_verifying(const PlacedLevel& at, std::span<const Point<World>> to_check,
                       ShownFrame& frame);
  void write_entries(const Visibility& visible, ShownFrame& frame);
  void write_wire(const PlacedScrew& screw, const Visibility& visible, ShownFrame& frame);
  void write_screw(const PlacedScrew& screw, const Visibility& visible, ShownFrame& frame);
  void write_cross(const PlacedScrew& screw, const Visibility& visible, ShownFrame& frame);
  void write_sizes(const Visibility& visible, ShownFrame& frame);
  void write_rods(const Guidance& guidance, ShownFrame& frame);
  void write_numbers(const nav::ScrewNumbers& numbers, nav::Side side, ShownFrame& frame);
  void write_status(const Guidance& guidance, const Visibility& visible, ShownFrame& frame);

  std::size_t used_ = 0;
  /// Landmarks by which a person compares the hologram with the bone; found once per model.
  std::map<const nav::VertebraModel*, std::array<Vec3, 4>> landmarks_m_;
};

}  // namespace orthonav::engine
