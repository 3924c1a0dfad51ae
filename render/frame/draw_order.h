#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "render/projection.h"
#include "render/scene.h"

namespace orthonav::render {

/// Orders the items of one kind independently of the order in which they were submitted: farther
/// ones first (by the middle of the item), then by label, then by content. Equal items are
/// interchangeable, so any order of them gives the same frame. Fills `order` with indices;
/// allocates only while `order` grows.
void sort_for_drawing(std::span<const MeshItem> items, const Head& head,
                      std::vector<std::uint32_t>& order);
void sort_for_drawing(std::span<const LineItem> items, const Head& head,
                      std::vector<std::uint32_t>& order);
void sort_for_drawing(std::span<const TriangleItem> items, const Head& head,
                      std::vector<std::uint32_t>& order);
void sort_for_drawing(std::span<const TextItem> items, const Head& head,
                      std::vector<std::uint32_t>& order);

}  // namespace orthonav::render
