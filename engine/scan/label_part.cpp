#include "engine/scan/label_part.h"

#include <algorithm>
#include <array>

namespace orthonav::engine {
namespace {

constexpr std::size_t kLeastVoxels = 100;
using Index = std::array<int, 3>;

/// The parts of a grid whose voxels are connected by faces.
class Parts {
 public:
  /// Voxels whose `member` is 1 belong to a part.
  Parts(const VolumeGrid& grid, const std::vector<std::uint8_t>& member)
      : grid_(grid), member_(member), part_(member.size(), 0) {
    Index at{};
    for (at[2] = 0; at[2] < grid.size[2]; ++at[2]) {
      for (at[1] = 0; at[1] < grid.size[1]; ++at[1]) {
        for (at[0] = 0; at[0] < grid.size[0]; ++at[0]) {
          const std::size_t i = grid.at(at[0], at[1], at[2]);
          if (member[i] != 0 && part_[i] == 0) {
            flood(at);
          }
        }
      }
    }
  }
  /// Counted from 1; 0: in no part.
  [[nodiscard]] std::uint32_t part_of(std::size_t voxel) const { return part_[voxel]; }
  [[nodiscard]] std::size_t size_of(std::uint32_t part) const { return sizes_[part - 1]; }
  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(sizes_.size()); }
  [[nodiscard]] std::uint32_t largest() const {
    const auto found = std::max_element(sizes_.begin(), sizes_.end());
    return static_cast<std::uint32_t>(found - sizes_.begin()) + 1;
  }

 private:
  void flood(const Index& start) {
    sizes_.push_back(0);
    const auto number = static_cast<std::uint32_t>(sizes_.size());
    std::vector<Index> open{start};
    part_[grid_.at(start[0], start[1], start[2])] = number;
    while (!open.empty()) {
      const Index here = open.back();
      open.pop_back();
      ++sizes_.back();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const int by : {-1, 1}) {
          Index next = here;
          next[axis] += by;
          if (next[axis] < 0 || next[axis] >= grid_.size[axis]) {
            continue;
          }
          const std::size_t i = grid_.at(next[0], next[1], next[2]);
          if (member_[i] != 0 && part_[i] == 0) {
            part_[i] = number;
            open.push_back(next);
          }
        }
      }
    }
  }

  const VolumeGrid& grid_;
  const std::vector<std::uint8_t>& member_;
  std::vector<std::uint32_t> part_;
  std::vector<std::size_t> sizes_;
};

/// Where a label lies.
struct Extent {
  Index low{1 << 30, 1 << 30, 1 << 30};
  Index high{-1, -1, -1};
};

/// Everything that the outside does not reach becomes bone.
void fill_cavities(LabelPart& part) {
  std::vector<std::uint8_t> free(part.inside.size());
  std::transform(part.inside.begin(), part.inside.end(), free.begin(),
                 [](std::uint8_t bone) { return bone != 0 ? 0 : 1; });
  const Parts parts(part.grid, free);
  const std::uint32_t outside = parts.part_of(0);
  for (std::size_t i = 0; i < free.size(); ++i) {
    part.inside[i] = parts.part_of(i) == outside ? 0 : 1;
  }
}

}  // namespace

Result<LabelPart> label_part(const Volume& labels, const LabelledLevel& level, int margin) {
  Extent extent;
  LabelPart part;
  for_each_voxel(labels, level, [&](const Index& at) {
    bool border = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      extent.low[axis] = std::min(extent.low[axis], at[axis]);
      extent.high[axis] = std::max(extent.high[axis], at[axis]);
      border = border || at[axis] == 0 || at[axis] == labels.grid.size[axis] - 1;
    }
    ++part.voxels;
    part.at_border += border ? 1 : 0;
  });
  if (part.voxels < kLeastVoxels) {
    return Error{level.label + " has " + std::to_string(part.voxels) + " voxels, must have " +
                 std::to_string(kLeastVoxels)};
  }
  part.grid = labels.grid;
  Vec3 first;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    part.grid.size[axis] = extent.high[axis] - extent.low[axis] + 1 + 2 * margin;
    first[static_cast<int>(axis)] = extent.low[axis] - margin;
  }
  part.grid.origin_m = labels.grid.place_m(first);
  part.inside.assign(part.grid.voxels(), 0);
  for_each_voxel(labels, level, [&](const Index& at) {
    part.inside[part.grid.at(at[0] - extent.low[0] + margin, at[1] - extent.low[1] + margin,
                             at[2] - extent.low[2] + margin)] = 1;
  });
  const Parts parts(part.grid, part.inside);
  const std::uint32_t largest = parts.largest();
  part.dropped = part.voxels - parts.size_of(largest);
  for (std::size_t i = 0; i < part.inside.size(); ++i) {
    part.inside[i] = parts.part_of(i) == largest ? 1 : 0;
  }
  fill_cavities(part);
  return part;
}

Result<Volume> dense_parts(const Volume& scan, double threshold_hu, double least_m3) {
  if (scan.layers != 1) {
    return Error{"has " + std::to_string(scan.layers) + " values a voxel, a CT has 1"};
  }
  std::vector<std::uint8_t> dense(scan.values.size());
  std::transform(scan.values.begin(), scan.values.end(), dense.begin(),
                 [&](float hu) { return static_cast<double>(hu) >= threshold_hu ? 1 : 0; });
  const Parts parts(scan.grid, dense);
  const double voxel_m3 = scan.grid.spacing_m.x * scan.grid.spacing_m.y * scan.grid.spacing_m.z;
  std::vector<std::uint32_t> kept;
  for (std::uint32_t part = 1; part <= parts.count(); ++part) {
    if (static_cast<double>(parts.size_of(part)) * voxel_m3 >= least_m3) {
      kept.push_back(part);
    }
  }
  if (kept.empty()) {
    return Error{"no connected part is large and dense enough"};
  }
  std::stable_sort(kept.begin(), kept.end(), [&](std::uint32_t a, std::uint32_t b) {
    return parts.size_of(a) > parts.size_of(b);
  });
  std::vector<float> number(parts.count() + 1, 0.0F);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    number[kept[i]] = static_cast<float>(i + 1);
  }
  Volume out;
  out.grid = scan.grid;
  out.values.resize(dense.size());
  for (std::size_t i = 0; i < dense.size(); ++i) {
    out.values[i] = number[parts.part_of(i)];
  }
  return out;
}

}  // namespace orthonav::engine
