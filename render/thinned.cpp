#include "render/thinned.h"

#include <algorithm>
#include <limits>

#include "render/float3.h"

namespace orthonav::render {
namespace {

constexpr float kGentleCosine = 0.97f;  // 14 degrees; line.vert closes a gap of that size
constexpr float kLeastSeen = 0.5f;      // of a length, when foreshortened
constexpr std::size_t kLongestRun = 8;  // points left out in a row: bounds the work

float squared_distance(Float3 p, Float3 a, Float3 b) {
  const Float3 along = b - a;
  const float squared_length = dot(along, along);
  const float t =
      squared_length > 0 ? std::clamp(dot(p - a, along) / squared_length, 0.0f, 1.0f) : 0.0f;
  const Float3 off = p - a - t * along;
  return dot(off, off);
}

/// How far the line may miss a point, squared.
float squared_slack(Float3 p, std::span<const Float3> eyes, float angle_rad) {
  float nearest = std::numeric_limits<float>::max();
  for (const Float3 eye : eyes) {
    nearest = std::min(nearest, dot(p - eye, p - eye));
  }
  return angle_rad * angle_rad * nearest;
}

}  // namespace

void thin(std::span<const Float3> points, std::span<const Float3> eyes, float angle_rad,
          std::vector<Float3>& kept) {
  kept.clear();
  if (!(angle_rad > 0)) {
    kept.insert(kept.end(), points.begin(), points.end());
    return;
  }
  std::size_t anchor = 0;
  while (anchor < points.size()) {
    kept.push_back(points[anchor]);
    std::size_t next = anchor + 1;
    while (next + 1 < points.size() && next - anchor <= kLongestRun) {
      const auto passes_by = [&](Float3 p) {
        return squared_distance(p, points[anchor], points[next + 1]) <=
               squared_slack(p, eyes, angle_rad);
      };
      const auto first = points.begin() + static_cast<std::ptrdiff_t>(anchor) + 1;
      const auto last = points.begin() + static_cast<std::ptrdiff_t>(next) + 1;
      if (!std::all_of(first, last, passes_by)) {
        break;
      }
      ++next;
    }
    anchor = next;
  }
}

bool bends_gently(Float3 a, Float3 b, Float3 c, std::span<const Float3> eyes) {
  const Float3 before = b - a;
  const Float3 after = c - b;
  return std::all_of(eyes.begin(), eyes.end(), [&](Float3 eye) {
    const Float3 ray = unit_or(b - eye, {0, 0, 1});
    const Float3 seen_before = before - dot(before, ray) * ray;
    const Float3 seen_after = after - dot(after, ray) * ray;
    const float length_before = length(seen_before);
    const float length_after = length(seen_after);
    return length_before > kLeastSeen * length(before) &&
           length_after > kLeastSeen * length(after) &&
           dot(seen_before, seen_after) > kGentleCosine * length_before * length_after;
  });
}

}  // namespace orthonav::render
