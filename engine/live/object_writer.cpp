#include "engine/live/object_writer.h"

#include <cmath>

#include "base/srgb.h"
#include "engine/holograms/scene_builder.h"
#include "engine/holograms/shapes/render_values.h"
#include "render/float3.h"
#include "render/frame/frame_items.h"
#include "render/text/text_layout.h"

namespace orthonav::engine {
namespace {

using render::Float3;

// A text is not moved while the difference is imperceptible: off by less than 1.5 px of a HoloLens
// 2 at arm's length, not turned about the line of sight, and of the same size.
constexpr double kTextMoved_m = 0.0003;
constexpr double kTextRotation_rad = 0.05;
constexpr double kTextGrown = 0.03;
/// Offset of the bars that stand for a rim, in cap heights.
constexpr double kBarAside_caps = 0.35;
constexpr double kBarWidth_caps = 0.12;

/// Colours as the display takes them: encoded as sRGB. Opacity is not encoded; black is transparent
/// anyway.
ObjectColour shown(render::Colour colour) {
  const auto encoded = [](float linear) {
    return static_cast<float>(srgb_from_linear(static_cast<double>(linear)));
  };
  return {encoded(colour.r), encoded(colour.g), encoded(colour.b), colour.a};
}

/// The smallest rotation that takes +y to the unit vector `to`.
Quaternion rotation_of_y_to(Vec3 to) {
  const double w = 1.0 + to.y;
  if (w < 1e-9) {
    return {1, 0, 0, 0};
  }
  const double norm = std::sqrt(w * w + to.z * to.z + to.x * to.x);
  return {to.z / norm, 0, -to.x / norm, w / norm};
}

Vec3 column(const render::Matrix4& m, int c) { return {m[c].x, m[c].y, m[c].z}; }

/// Without blanks in front and spaces at the end, which displays treat differently; cap heights
/// taken off the front go to `front_caps`.
render::TextItem trimmed(const render::TextItem& item, const render::Font& font,
                         float& front_caps) {
  render::TextItem line;
  line.rim = item.rim;  // its letters are farther apart
  render::TextRun& run = line.runs.emplace_back();
  for (const render::TextRun& part : item.runs) {
    run.text += part.text;
  }
  std::string_view text = run.text;
  for (std::string_view rest = text; const auto code = render::take_code_point(rest); text = rest) {
    if (*code != U' ' && *code != U'\u2007') {
      break;
    }
    front_caps += font.glyph(*code).advance + (item.rim.a > 0 ? render::kRimWidth : 0.0f);
  }
  while (!text.empty() && text.back() == ' ') {
    text.remove_suffix(1);
  }
  run.text = std::string(text);
  return line;
}

/// From the anchor to the middle of the text, in cap heights to the right.
float middle_caps(const render::TextItem& item, float whole, float front, float written) {
  const float begins = item.align == render::TextAlign::kLeft     ? 0.0f
                       : item.align == render::TextAlign::kCentre ? -0.5f * whole
                                                                  : -whole;
  return item.offset_right + begins + front + 0.5f * written;
}

}  // namespace

void ObjectWriter::begin(ObjectList& list) {
  list_ = &list;
  counts_.clear();
}

void ObjectWriter::label(render::Label label) {
  label_ = label;
  of_tool_ = list_->tool_time.has_value() && depends_on_tool(label);
  place_ = ObjectPlace::kWorld;
}

DisplayObject& ObjectWriter::add(Part part, ObjectShape shape, render::Colour colour) {
  DisplayObject& object = list_->objects.emplace_back();
  const std::uint32_t number = counts_[{label_, part}]++;
  object.key =
      std::uint64_t{label_} << 32 | std::uint64_t{static_cast<std::uint8_t>(part)} << 24 | number;
  object.shape = shape;
  object.place = place_;
  object.follows_tool = of_tool_;
  object.colour = shown(colour);
  return object;
}

void ObjectWriter::add_ball(Float3 centre, float radius_m, render::Colour colour,
                            ObjectShape shape) {
  DisplayObject& object = add(Part::kBall, shape, colour);
  object.position_m = to_vec3(centre);
  // Makes a cube's corners reach as far out as the octahedron's.
  const double size_m = shape == ObjectShape::kCube ? 2.0 / std::sqrt(3.0) : 2.0;
  object.scale = size_m * static_cast<double>(radius_m) * Vec3{1, 1, 1};
  if (shape == ObjectShape::kCube) {
    const double root = 1.0 / std::sqrt(3.0);
    const Quaternion q = rotation_of_y_to({root, root, root});
    object.rotation = {-q.x, 0, -q.z, q.w};
  }
}

void ObjectWriter::add_piece(const StraightPiece& piece, float width_m, render::Colour colour) {
  const Vec3 from = to_vec3(piece[0]);
  const Vec3 to = to_vec3(piece[1]);
  const double length_m = (to - from).norm();
  if (!(length_m > 1e-6)) {
    return;
  }
  DisplayObject& object = add(Part::kPiece, ObjectShape::kCylinder, colour);
  object.position_m = 0.5 * (from + to);
  object.rotation = rotation_of_y_to((1.0 / length_m) * (to - from));
  object.scale = {width_m, 0.5 * length_m, width_m};
}

void ObjectWriter::add_text(const render::TextItem& item, const render::Head& head) {
  float front_caps = 0;
  const render::TextItem line = trimmed(item, font_, front_caps);
  if (line.runs.front().text.empty()) {
    return;
  }
  const bool on_head = item.place == render::TextPlace::kView;
  place_ = on_head ? ObjectPlace::kHead : ObjectPlace::kWorld;
  const render::Matrix4 world_from_caps =
      render::world_from_caps(item, on_head ? render::Head{} : head);
  const Vec3 right = column(world_from_caps, 0);
  const Vec3 up = column(world_from_caps, 1);
  const float written_caps = render::line_width(font_, line);
  const double middle =
      middle_caps(item, render::line_width(font_, item), front_caps, written_caps);
  DisplayObject& object = add(Part::kText, ObjectShape::kText, item.runs.front().colour);
  const Vec3 x = right.normalized();
  const Vec3 y = up.normalized();
  const Vec3 z = column(world_from_caps, 2);
  Lying lying{column(world_from_caps, 3) + middle * right + (0.5 + item.offset_up) * up,
              quaternion_from_rotation(Mat3::from_columns(x, y, z)), up.norm()};
  steady(object.key, lying);
  object.position_m = lying.position_m;
  object.rotation = lying.rotation;
  object.cap_height_m = lying.cap_height_m;
  object.text = line.runs.front().text;
  if (item.rim.a > 0) {
    add_bars(item, lying, 0.5 * written_caps);
  }
}

/// Keeps the text's previous pose if the difference is imperceptible.
void ObjectWriter::steady(std::uint64_t key, Lying& lying) {
  const auto [found, is_new] = lying_.try_emplace(key, lying);
  Lying& before = found->second;
  before.used = true;
  const Mat3 was = rotation_from_quaternion(before.rotation);
  const Mat3 is = rotation_from_quaternion(lying.rotation);
  // Turning a text about the line of sight moves its ends.
  const Vec3 right = is.column(0);
  const Vec3 up = was.column(1);
  const bool same =
      (lying.position_m - before.position_m).norm() < kTextMoved_m &&
      rotation_angle_rad(was, is) < kTextRotation_rad &&
      std::abs(right.dot(up)) < 0.1 * kTextRotation_rad &&
      std::abs(lying.cap_height_m - before.cap_height_m) < kTextGrown * before.cap_height_m;
  if (is_new || !same) {
    before = lying;
  }
  lying = before;
}

void ObjectWriter::add_bars(const render::TextItem& item, const Lying& lying,
                            double half_width_caps) {
  const Mat3 rotation = rotation_from_quaternion(lying.rotation);
  const Vec3 right = rotation.column(0);
  const Vec3 up = rotation.column(1);
  const double cap_m = lying.cap_height_m;
  for (const double side : {1.0, -1.0}) {
    DisplayObject& bar = add(Part::kBar, ObjectShape::kCylinder, item.rim);
    bar.position_m = lying.position_m + side * (0.5 + kBarAside_caps) * cap_m * up;
    bar.rotation = rotation_of_y_to(right);
    bar.scale = {kBarWidth_caps * cap_m, half_width_caps * cap_m, kBarWidth_caps * cap_m};
  }
}

void ObjectWriter::end() {
  for (auto each = lying_.begin(); each != lying_.end();) {
    each = std::exchange(each->second.used, false) ? std::next(each) : lying_.erase(each);
  }
}

}  // namespace orthonav::engine
