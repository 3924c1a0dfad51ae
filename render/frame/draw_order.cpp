#include "render/frame/draw_order.h"

#include <compare>
#include <numeric>
#include <tuple>

#include "render/float3.h"

namespace orthonav::render {
namespace {

Float3 middle(const LineItem& item) {
  Float3 sum{};
  for (const Float3 point : item.points) {
    sum = sum + point;
  }
  return item.points.empty() ? sum : (1.0f / static_cast<float>(item.points.size())) * sum;
}

Float3 middle(const TriangleItem& item) {
  return (1.0f / 3.0f) * (item.corners[0] + item.corners[1] + item.corners[2]);
}

/// Squared distance from the point between the eyes.
float distance2(const MeshItem& item, const Head& head, const BoxOf& box_of) {
  const Box box = box_of(item);
  const Float3 from_head =
      transformed(item.world_from_model, 0.5f * (box.low + box.high)) - head.position;
  return dot(from_head, from_head);
}

template <class Item>
float distance2(const Item& item, const Head& head) {
  const Float3 from_head = middle(item) - head.position;
  return dot(from_head, from_head);
}

float distance2(const TextItem& item, const Head& head) {
  const bool in_world = item.place == TextPlace::kWorld;
  const Float3 from_head = in_world ? item.position - head.position : item.position;
  return dot(from_head, from_head);
}

auto key(Float3 p) { return std::tuple(p.x, p.y, p.z); }
auto key(Float4 v) { return std::tuple(v.x, v.y, v.z, v.w); }
auto key(const Colour& c) { return std::tuple(c.r, c.g, c.b, c.a); }

template <class Range>
std::partial_ordering compare_points(const Range& a, const Range& b) {
  return std::lexicographical_compare_three_way(
      a.begin(), a.end(), b.begin(), b.end(),
      [](Float3 p, Float3 q) -> std::partial_ordering { return key(p) <=> key(q); });
}

bool content_less(const MeshItem& a, const MeshItem& b) {
  const auto key_of = [](const MeshItem& item) {
    const Matrix4& m = item.world_from_model;
    return std::tuple(key(m[0]), key(m[1]), key(m[2]), key(m[3]), key(item.colour), key(item.tint),
                      item.style, item.mesh->positions.size(), item.mesh->indices.size());
  };
  if (const auto order = key_of(a) <=> key_of(b); order != 0) {
    return order < 0;
  }
  if (a.mesh == b.mesh) {
    return false;
  }
  if (const auto order = compare_points(a.mesh->positions, b.mesh->positions); order != 0) {
    return order < 0;
  }
  if (const auto order = compare_points(a.mesh->normals, b.mesh->normals); order != 0) {
    return order < 0;
  }
  return std::tie(a.mesh->indices, a.mesh->tints) < std::tie(b.mesh->indices, b.mesh->tints);
}

bool content_less(const LineItem& a, const LineItem& b) {
  const auto key_of = [](const LineItem& item) {
    return std::tuple(key(item.colour), item.width_m, item.dash_m, item.closed);
  };
  if (const auto order = key_of(a) <=> key_of(b); order != 0) {
    return order < 0;
  }
  return compare_points(a.points, b.points) < 0;
}

bool content_less(const TriangleItem& a, const TriangleItem& b) {
  const auto order = key(a.colour) <=> key(b.colour);
  return order != 0 ? order < 0 : compare_points(a.corners, b.corners) < 0;
}

bool content_less(const TextItem& a, const TextItem& b) {
  const auto key_of = [](const TextItem& item) {
    return std::tuple(key(item.position), item.place, item.align, item.height_m,
                      item.min_height_deg, key(item.rim), item.offset_right, item.offset_up);
  };
  if (const auto order = key_of(a) <=> key_of(b); order != 0) {
    return order < 0;
  }
  return std::lexicographical_compare(a.runs.begin(), a.runs.end(), b.runs.begin(), b.runs.end(),
                                      [](const TextRun& r, const TextRun& s) {
                                        const int texts = r.text.compare(s.text);
                                        return texts != 0 ? texts < 0
                                                          : key(r.colour) < key(s.colour);
                                      });
}

template <class Item, class Distance2>
void sort_items(std::span<const Item> items, const Distance2& distance2_of,
                std::vector<std::uint32_t>& order) {
  order.resize(items.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    const float a = distance2_of(items[i]);
    const float b = distance2_of(items[j]);
    if (a != b) {
      return a > b;
    }
    if (items[i].label != items[j].label) {
      return items[i].label < items[j].label;
    }
    return content_less(items[i], items[j]);
  });
}

/// Of items whose middle is seen from the items themselves.
template <class Item>
void sort_items(std::span<const Item> items, const Head& head, std::vector<std::uint32_t>& order) {
  sort_items(
      items, [&](const Item& item) { return distance2(item, head); }, order);
}

}  // namespace

void sort_for_drawing(std::span<const MeshItem> items, const Head& head, const BoxOf& box_of,
                      std::vector<std::uint32_t>& order) {
  sort_items(
      items, [&](const MeshItem& item) { return distance2(item, head, box_of); }, order);
}
void sort_for_drawing(std::span<const LineItem> items, const Head& head,
                      std::vector<std::uint32_t>& order) {
  sort_items(items, head, order);
}
void sort_for_drawing(std::span<const TriangleItem> items, const Head& head,
                      std::vector<std::uint32_t>& order) {
  sort_items(items, head, order);
}
void sort_for_drawing(std::span<const TextItem> items, const Head& head,
                      std::vector<std::uint32_t>& order) {
  sort_items(items, head, order);
}

}  // namespace orthonav::render
