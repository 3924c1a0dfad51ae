#include "study/surgeon/written_frame.h"

#include <string>

#include "hal/hl2ss/standin_values.h"

namespace orthonav::sim {
namespace {

using engine::ChecksAsked;
using engine::HologramKind;
using engine::Notice;
using engine::ShownFrame;
using engine::ShownHologram;
using engine::ShownStatus;
using engine::Step;
using hl2ss::append;
using hl2ss::append_text;
using hl2ss::append_time;
using hl2ss::ByteReader;
using hl2ss::take_text;
using hl2ss::take_time;

constexpr std::uint8_t kNoSide = 255;

void append_side(std::vector<std::uint8_t>& bytes, const std::optional<Side>& side) {
  append(bytes, side ? static_cast<std::uint8_t>(*side) : kNoSide);
}

/// Reads one of the values from `first` to `last`; otherwise sets `problem`.
template <class Enum>
Enum take_one(ByteReader& reader, Enum first, Enum last, const char* what, Status& problem) {
  const auto value = reader.take<std::uint8_t>();
  if (!reader.ok()) {
    return first;
  }
  if (value < static_cast<std::uint8_t>(first) || value > static_cast<std::uint8_t>(last)) {
    problem = Error{std::string("shown frame: unknown ") + what + ", " + std::to_string(value)};
    return first;
  }
  return static_cast<Enum>(value);
}

std::optional<Side> take_side(ByteReader& reader, Status& problem) {
  const auto value = reader.take<std::uint8_t>();
  if (!reader.ok() || value == kNoSide) {
    return std::nullopt;
  }
  if (value > static_cast<std::uint8_t>(Side::kRight)) {
    problem = Error{"shown frame: unknown side, " + std::to_string(value)};
  }
  return static_cast<Side>(value);
}

void append_status(std::vector<std::uint8_t>& bytes, const ShownStatus& status) {
  append(bytes, static_cast<std::uint8_t>(status.at.step));
  append_text(bytes, status.at.level);
  append_side(bytes, status.at.side);
  append(bytes, static_cast<std::uint8_t>(status.notice));
  append(bytes, static_cast<std::uint8_t>(status.checks));
  append(bytes, static_cast<std::uint8_t>(status.strokes_enough));
  append_text(bytes, status.text);
  append_text(bytes, status.heard);
}

Status take_status(ByteReader& reader, ShownStatus& status) {
  Status problem;
  status.at.step = take_one(reader, Step::kSetup, Step::kDone, "step", problem);
  status.at.level = take_text(reader);
  status.at.side = take_side(reader, problem);
  status.notice = take_one(reader, Notice::kNone, Notice::kEnded, "notice", problem);
  status.checks = take_one(reader, ChecksAsked::kNone, ChecksAsked::kPassed, "checks", problem);
  status.strokes_enough = reader.take<std::uint8_t>() != 0;
  status.text = take_text(reader);
  status.heard = take_text(reader);
  return problem;
}

void append_hologram(std::vector<std::uint8_t>& bytes, const ShownHologram& hologram) {
  append(bytes, static_cast<std::uint8_t>(hologram.kind));
  append_text(bytes, hologram.level);
  append_side(bytes, hologram.side);
  append_text(bytes, hologram.text);
  append(bytes, static_cast<std::uint8_t>(hologram.reading.has_value()));
  append(bytes, hologram.reading.value_or(0.0));
  append(bytes, static_cast<std::uint32_t>(hologram.points_in_world.size()));
  for (const Point<World>& point : hologram.points_in_world) {
    for (int i = 0; i < 3; ++i) {
      append(bytes, point.v[i]);
    }
  }
}

Status take_points(ByteReader& reader, std::vector<Point<World>>& points) {
  const auto count = reader.take<std::uint32_t>();
  for (std::uint32_t k = 0; k < count && reader.ok(); ++k) {
    Point<World> point;
    for (int axis = 0; axis < 3; ++axis) {
      point.v[axis] = reader.take<double>();
    }
    if (!point.v.is_finite()) {
      return Error{"shown frame: a point that is not finite"};
    }
    points.push_back(point);
  }
  return {};
}

Status take_hologram(ByteReader& reader, ShownHologram& hologram) {
  Status problem;
  hologram.kind =
      take_one(reader, HologramKind::kPath, static_cast<HologramKind>(engine::kHolograms.size()),
               "hologram", problem);
  hologram.level = take_text(reader);
  hologram.side = take_side(reader, problem);
  hologram.text = take_text(reader);
  const bool has_reading = reader.take<std::uint8_t>() != 0;
  const auto reading = reader.take<double>();
  if (has_reading) {
    hologram.reading = reading;
  }
  const Status points = take_points(reader, hologram.points_in_world);
  return problem ? points : problem;
}

}  // namespace

WornFrame written(const ShownFrame& shown) {
  WornFrame frame;
  frame.display_time = shown.display_time;
  std::vector<std::uint8_t>& bytes = frame.content;
  append_time(bytes, shown.pose_time);
  append(bytes, static_cast<std::uint8_t>(shown.status.has_value()));
  if (shown.status) {
    append_status(bytes, *shown.status);
  }
  append(bytes, static_cast<std::uint32_t>(shown.holograms.size()));
  for (const ShownHologram& hologram : shown.holograms) {
    append_hologram(bytes, hologram);
  }
  return frame;
}

Result<ShownFrame> shown_in(const WornFrame& frame) {
  ShownFrame shown;
  ByteReader reader(frame.content);
  shown.display_time = frame.display_time;
  shown.pose_time = take_time(reader);
  if (reader.take<std::uint8_t>() != 0) {
    if (const Status taken = take_status(reader, shown.status.emplace()); !taken) {
      return taken.error();
    }
  }
  const auto count = reader.take<std::uint32_t>();
  for (std::uint32_t i = 0; i < count && reader.ok(); ++i) {
    ShownHologram& hologram = shown.holograms.emplace_back();
    if (const Status taken = take_hologram(reader, hologram); !taken) {
      return taken.error();
    }
    for (Point<World>& point : hologram.points_in_world) {
      point = frame.wearer_from_drawn * point;
    }
  }
  if (!reader.ok() || reader.left() > 0) {
    return Error{"shown frame: " + std::to_string(frame.content.size()) +
                 " bytes do not fit its contents"};
  }
  return shown;
}

}  // namespace orthonav::sim
