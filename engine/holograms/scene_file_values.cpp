#include "engine/holograms/scene_file_values.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/angle.h"
#include "base/printed.h"
#include "engine/holograms/shapes/render_values.h"
#include "render/float3.h"

namespace orthonav::engine {
namespace {

using render::Float3;

/// Refuses a place that is farther away than any room is large.
Vec3 near_origin(const JsonNode& node, const char* key, Vec3 place_mm) {
  for (const double mm : {place_mm.x, place_mm.y, place_mm.z}) {
    if (!(std::abs(mm) <= kFarthest_mm)) {
      node.refuse(key, "holds " + printed("%g", mm) + ", must lie within 10000 mm of the origin");
    }
  }
  return place_mm;
}

}  // namespace

double number_between(const JsonNode& node, const char* key, double low, double high,
                      const char* unit) {
  const double value = node.number(key);
  if (!(value >= low && value <= high)) {
    node.refuse(key, "is " + printed("%f", value) + ", must lie in [" + std::to_string(low) + ", " +
                         std::to_string(high) + "] " + unit);
  }
  return value;
}

float length_from(const JsonNode& node, const char* key, double low_mm, double high_mm) {
  return static_cast<float>(number_between(node, key, low_mm, high_mm, "mm") * 1e-3);
}

Float3 place_from(const JsonNode& node, const char* key) {
  return to_float3(near_origin(node, key, node.vec3(key)) * 1e-3);
}

Float3 direction_from(const JsonNode& node, const char* key) {
  const Float3 given = to_float3(node.vec3(key));
  const float length = render::length(given);
  if (!(length > 1e-6f)) {
    node.refuse(key, "has no direction");
  }
  return render::unit_or(given, {0, 1, 0});
}

std::vector<Float3> places_from(const JsonNode& node, const char* key) {
  std::vector<Float3> places;
  for (const Vec3 place_mm : node.vec3s(key)) {
    places.push_back(to_float3(near_origin(node, key, place_mm) * 1e-3));
  }
  return places;
}

std::size_t word_from(const JsonNode& node, const char* key, std::span<const char* const> words) {
  const std::string word = node.text_or(key, words.front());
  const auto found = std::find(words.begin(), words.end(), word);
  if (found != words.end()) {
    return static_cast<std::size_t>(found - words.begin());
  }
  std::string choice;
  for (const char* known : words) {
    choice += std::string(choice.empty() ? "" : ", ") + known;
  }
  node.refuse(key, "is \"" + word + "\", must be one of " + choice);
  return 0;
}

std::optional<double> angle_from(const JsonNode& node) {
  if (!node.has("angle_deg")) {
    return std::nullopt;
  }
  return number_between(node, "angle_deg", 0.0, 180.0, "deg") * kRadiansPerDegree;
}

Grade grade_from(const JsonNode& node) { return grade_of(angle_from(node).value_or(1.0)); }

render::Colour colour_from(const JsonNode& node) {
  if (!node.has("colour")) {
    return look::kWhite;
  }
  const Vec3 rgb = node.vec3("colour");
  for (const double channel : {rgb.x, rgb.y, rgb.z}) {
    if (!(channel >= 0.0 && channel <= 1.0)) {
      node.refuse("colour", "must lie in [0, 1], linear");
    }
  }
  return {static_cast<float>(rgb.x), static_cast<float>(rgb.y), static_cast<float>(rgb.z), 1};
}

}  // namespace orthonav::engine
