#include "bench/contour_errors.h"

#include <algorithm>
#include <cmath>

#include "render/float3.h"

namespace orthonav {
namespace {

using engine::StraightPiece;
using render::Float3;

constexpr float kAway_m = 0.5f;
constexpr float kEyesApart_m = 0.063f;
constexpr float kStep_m = 0.001f;
/// Age of what is shown: from mid-exposure until the headset shows it, assumed (78 ms measured on
/// loopback).
constexpr double kShownAfter_s = 0.087;
constexpr double kFrame_s = 1.0 / 60.0;
constexpr int kFramesAPair = 2;
constexpr int kFrames = 120;

/// A place of the head 0.5 m from the bone: turned about the patient's long axis (z), tilted
/// towards the patient's head.
Float3 head_at(double yaw_rad, double tilt_rad = 0.3) {
  return kAway_m * Float3{static_cast<float>(std::sin(yaw_rad) * std::cos(tilt_rad)),
                          static_cast<float>(std::cos(yaw_rad) * std::cos(tilt_rad)),
                          static_cast<float>(std::sin(tilt_rad))};
}

std::vector<Float3> sides() {
  std::vector<Float3> heads;
  for (int yaw = -4; yaw <= 4; ++yaw) {
    for (int tilt = -1; tilt <= 1; ++tilt) {
      heads.push_back(head_at(0.2 * yaw, 0.4 * tilt));
    }
  }
  return heads;
}

/// What an eye sees, in metres across the line of sight at the bone's depth.
class Seen {
 public:
  explicit Seen(Float3 eye) : eye_(eye), back_(render::unit_or(eye, {})) {
    right_ = render::unit_or(render::cross({0, 0, 1}, back_), {});
    up_ = render::cross(back_, right_);
  }
  [[nodiscard]] Float3 operator()(Float3 p) const {
    const Float3 way = p - eye_;
    const float scale = length(eye_) / -dot(way, back_);
    return {scale * dot(way, right_), scale * dot(way, up_), 0};
  }

 private:
  Float3 eye_{}, back_{}, right_{}, up_{};
};

std::vector<StraightPiece> seen(const std::vector<StraightPiece>& pieces, const Seen& see) {
  std::vector<StraightPiece> flat;
  for (const StraightPiece& piece : pieces) {
    flat.push_back({see(piece[0]), see(piece[1])});
  }
  return flat;
}

double distance_mm(Float3 p, const std::vector<StraightPiece>& pieces) {
  float least = 1e9f;
  for (const StraightPiece& piece : pieces) {
    least = std::min(least, render::squared_distance_to_segment(p, piece[0], piece[1]));
  }
  return 1e3 * static_cast<double>(std::sqrt(least));
}

void add_distances(const std::vector<StraightPiece>& from, const std::vector<StraightPiece>& to,
                   std::vector<double>& errors_mm) {
  for (const StraightPiece& piece : from) {
    const float length_m = length(piece[1] - piece[0]);
    const auto steps = static_cast<int>(std::ceil(length_m / kStep_m));
    for (int i = 0; i < steps; ++i) {
      const float part = (static_cast<float>(i) + 0.5f) / static_cast<float>(steps);
      errors_mm.push_back(distance_mm(piece[0] + part * (piece[1] - piece[0]), to));
    }
  }
}

std::vector<StraightPiece> pieces_of(const std::vector<engine::SurfaceContours::Line>& lines) {
  std::vector<StraightPiece> pieces;
  for (const auto& line : lines) {
    engine::append_pieces(line, pieces);
  }
  return pieces;
}

/// Onto the plane through the origin that faces the head.
std::vector<StraightPiece> flattened(std::vector<StraightPiece> pieces, Float3 head) {
  const Float3 normal = render::unit_or(head, {});
  for (StraightPiece& piece : pieces) {
    for (Float3& p : piece) {
      const Float3 way = p - head;
      p = head + (-length(head) / dot(way, normal)) * way;
    }
  }
  return pieces;
}

}  // namespace

ContourBench::ContourBench(std::shared_ptr<const render::MeshData> bone)
    : truth_(*bone, bone->indices.size()) {
  item_.mesh = std::move(bone);
}

void ContourBench::judge(const std::vector<StraightPiece>& drawn, Float3 head,
                         ContourErrors& errors) const {
  const Float3 right = render::unit_or(render::cross({0, 0, 1}, render::unit_or(head, {})), {});
  for (const float side : {-0.5f, 0.5f}) {
    const Float3 eye = head + side * kEyesApart_m * right;
    const Seen see(eye);
    const auto truth = seen(pieces_of(truth_.seen_from(eye)), see);
    const auto shown = seen(drawn, see);
    add_distances(shown, truth, errors.drawn_mm);
    add_distances(truth, shown, errors.missed_mm);
  }
}

ContourErrors ContourBench::at_rest(bool on_a_quad) const {
  ContourErrors errors;
  engine::BoneLines lines;
  Timestamp now{};
  for (const Float3 head : sides()) {
    now += std::chrono::seconds(1);
    const auto drawn = lines.pieces(item_, head, now);
    judge(on_a_quad ? flattened(drawn, head) : drawn, head, errors);
  }
  return errors;
}

ContourErrors ContourBench::in_motion(double rotation_rad_s, bool on_a_quad) const {
  ContourErrors errors;
  engine::BoneLines lines;
  std::vector<StraightPiece> drawn;
  Float3 drawn_for{};
  for (int frame = 0; frame < kFrames; ++frame) {
    const double time_s = frame * kFrame_s;
    const double begin_rad = -0.5 * rotation_rad_s * kFrames * kFrame_s;
    if (frame % kFramesAPair == 0) {
      const Float3 then = head_at(begin_rad + rotation_rad_s * (time_s - kShownAfter_s));
      const auto& found = lines.pieces(item_, then, Timestamp(from_seconds(time_s)));
      if (found != drawn) {
        drawn = found;
        drawn_for = then;
      }
    }
    if (frame % 4 == 0) {
      judge(on_a_quad ? flattened(drawn, drawn_for) : drawn,
            head_at(begin_rad + rotation_rad_s * time_s), errors);
    }
  }
  return errors;
}

double ContourBench::pieces() const {
  engine::BoneLines lines;
  Timestamp now{};
  double sum = 0;
  for (const Float3 head : sides()) {
    now += std::chrono::seconds(1);
    sum += static_cast<double>(lines.pieces(item_, head, now).size());
  }
  return sum / static_cast<double>(sides().size());
}

}  // namespace orthonav
