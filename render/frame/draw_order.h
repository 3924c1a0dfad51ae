#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "render/frame/screen_bounds.h"
#include "render/projection.h"
#include "render/scene.h"

namespace orthonav::render {

/// Orders the items of one kind independently of the order in which they were submitted: farther
/// ones first (by the middle of the item; a mesh's is that of its bounding box, which `box_of`
/// gives), then by label, then by content. Equal items are interchangeable, so any order of them
/// gives the same frame. Fills `order` with indices; allocates only while `order` grows.
void sort_for_drawing(std::span<const MeshItem> items, const Head& head, const BoxOf& box_of,
                      std::vector<std::uint32_t>& order);
void sort_for_drawing(std::span<const LineItem> items, const Head& head,
                      std::vector<std::uint32_t>& order);
void sort_for_drawing(std::span<const TriangleItem> items, const Head& head,
                      std::vector<std::uint32_t>& order);
void sort_for_drawing(std::span<const TextItem> items, const Head& head,
                      std::vector<std::uint32_t>& order);

}  // namespace orthonav::render
