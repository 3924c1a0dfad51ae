#include "nav/geometry/mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "base/printed.h"

namespace orthonav::nav {
namespace {

constexpr double kSmallest_m = 0.030;
constexpr double kLargestVertebra_m = 0.250;
/// A long femur has 550 mm.
constexpr double kLargestBone_m = 0.600;
/// An open part counts as the bone only if it encloses this many times as much as any closed one.
constexpr double kOpenIsTheBone = 10.0;
/// Below this fraction of the bounding cube's volume, a mesh is folded flat and has no interior.
constexpr double kMinVolumeFraction = 1e-4;

struct DirectedEdge {
  std::uint32_t low;
  std::uint32_t high;
  bool upward;  ///< runs from low to high
};

std::string number(double value, const char* format) { return printed(format, value); }

Status check_numbers(const TriangleMesh& mesh) {
  if (mesh.triangles.empty() || mesh.vertices_m.empty()) {
    return Error{"mesh has no faces"};
  }
  for (std::size_t i = 0; i < mesh.vertices_m.size(); ++i) {
    if (!mesh.vertices_m[i].is_finite()) {
      return Error{"mesh vertex " + std::to_string(i) + " is not finite"};
    }
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    for (const std::uint32_t v : t) {
      if (v >= mesh.vertices_m.size()) {
        return Error{"mesh face " + std::to_string(i) + " names vertex " + std::to_string(v) +
                     ", but there are only " + std::to_string(mesh.vertices_m.size())};
      }
    }
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
      return Error{"mesh is not manifold: face " + std::to_string(i) + " names vertex " +
                   std::to_string(t[0] == t[1] ? t[0] : t[2]) + " twice"};
    }
  }
  return {};
}

/// The largest extent along any axis.
double extent_m(const TriangleMesh& mesh) {
  const auto [low, high] = bounds_of(mesh);
  return std::max({high.x - low.x, high.y - low.y, high.z - low.z});
}

Status check_size(double size_m, Bone bone) {
  const bool vertebra = bone == Bone::kVertebra;
  const auto plausible = [&](double m) {
    return m >= kSmallest_m && m <= (vertebra ? kLargestVertebra_m : kLargestBone_m);
  };
  if (plausible(size_m)) {
    return {};
  }
  std::string message =
      "mesh is " + number(size_m * 1e3, "%.6g") + " mm across, " +
      (vertebra ? "limit 30-250 mm for a vertebra (a lumbar one is 60-130 mm)" : "limit 30-600 mm");
  if (plausible(size_m * 1e3)) {
    message += ": its unit looks like metres taken for millimetres";
  } else if (plausible(size_m * 1e-3)) {
    message += ": its unit looks like millimetres taken for metres";
  } else if (vertebra && size_m > kLargestVertebra_m && size_m <= kLargestBone_m) {
    message += "; register takes another bone with --any-bone";
  }
  return Error{message};
}

std::vector<DirectedEdge> sorted_edges(const TriangleMesh& mesh) {
  std::vector<DirectedEdge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k];
      const std::uint32_t b = t[(k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), a < b});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const DirectedEdge& a, const DirectedEdge& b) {
    return std::tie(a.low, a.high, a.upward) < std::tie(b.low, b.high, b.upward);
  });
  return edges;
}

/// Calls `act` with the first of each edge's entries and how many there are.
template <class Act>
void for_each_edge(const std::vector<DirectedEdge>& sorted, const Act& act) {
  for (std::size_t i = 0; i < sorted.size();) {
    std::size_t j = i;
    while (j < sorted.size() && sorted[j].low == sorted[i].low &&
           sorted[j].high == sorted[i].high) {
      ++j;
    }
    act(&sorted[i], j - i);
    i = j;
  }
}

Status check_closed(const TriangleMesh& mesh) {
  const std::vector<DirectedEdge> edges = sorted_edges(mesh);
  std::size_t open = 0;
  std::size_t crowded = 0;
  std::size_t against = 0;
  for_each_edge(edges, [&](const DirectedEdge* edge, std::size_t count) {
    open += count == 1 ? 1 : 0;
    crowded += count > 2 ? 1 : 0;
    against += count == 2 && edge[0].upward == edge[1].upward ? 1 : 0;
  });
  if (open > 0) {
    return Error{"mesh is open: " + std::to_string(open) +
                 " edges have one face, must have two: close it, in MeshLab by Close Holes"};
  }
  if (crowded > 0) {
    return Error{"mesh is not manifold: " + std::to_string(crowded) +
                 " edges have more than two faces"};
  }
  if (against > 0) {
    return Error{"mesh is not oriented: the faces at " + std::to_string(against) +
                 " edges are wound against each other"};
  }
  return {};
}

}  // namespace

Bounds bounds_of(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) {
    return {};
  }
  Bounds box{mesh.vertices_m[mesh.triangles[0][0]], mesh.vertices_m[mesh.triangles[0][0]]};
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t v : t) {
      for (int axis = 0; axis < 3; ++axis) {
        box.low[axis] = std::min(box.low[axis], mesh.vertices_m[v][axis]);
        box.high[axis] = std::max(box.high[axis], mesh.vertices_m[v][axis]);
      }
    }
  }
  return box;
}

Solid solid_of(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) {
    return {};
  }
  // About a vertex, so that a model far from its origin keeps its precision.
  const Vec3 o = mesh.vertices_m[mesh.triangles[0][0]];
  double six_volumes = 0.0;
  Vec3 moment;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices_m[t[0]] - o;
    const Vec3 b = mesh.vertices_m[t[1]] - o;
    const Vec3 c = mesh.vertices_m[t[2]] - o;
    const double part = a.dot(b.cross(c));
    six_volumes += part;
    moment += part / 4.0 * (a + b + c);
  }
  const Vec3 centre = six_volumes == 0.0 ? Vec3{} : 1.0 / six_volumes * moment;
  return {six_volumes / 6.0, o + centre};
}

Result<TriangleMesh> checked_bone(TriangleMesh mesh, Bone bone) {
  if (const Status s = check_numbers(mesh); !s) {
    return s.error();
  }
  const double size_m = extent_m(mesh);
  if (const Status s = check_size(size_m, bone); !s) {
    return s.error();
  }
  if (const Status s = check_closed(mesh); !s) {
    return s.error();
  }
  const double volume_m3 = solid_of(mesh).volume_m3;
  if (std::abs(volume_m3) < kMinVolumeFraction * size_m * size_m * size_m) {
    return Error{"mesh encloses no volume (" + number(volume_m3 * 1e9, "%.3g") + " mm3)"};
  }
  if (volume_m3 < 0.0) {
    for (auto& t : mesh.triangles) {
      std::swap(t[1], t[2]);
    }
  }
  return mesh;
}

TriangleMesh welded(const TriangleMesh& mesh) {
  TriangleMesh result;
  std::map<std::array<std::uint64_t, 3>, std::uint32_t> known;
  std::vector<std::uint32_t> renamed;
  renamed.reserve(mesh.vertices_m.size());
  for (const Vec3& v : mesh.vertices_m) {
    // Compared by their bits, so that non-finite numbers too have an order; adding zero turns -0
    // into +0.
    const std::array<std::uint64_t, 3> key = {std::bit_cast<std::uint64_t>(v.x + 0.0),
                                              std::bit_cast<std::uint64_t>(v.y + 0.0),
                                              std::bit_cast<std::uint64_t>(v.z + 0.0)};
    const auto next = static_cast<std::uint32_t>(result.vertices_m.size());
    const auto [entry, added] = known.try_emplace(key, next);
    if (added) {
      result.vertices_m.push_back(v);
    }
    renamed.push_back(entry->second);
  }
  for (std::array<std::uint32_t, 3> t : mesh.triangles) {
    bool valid = true;
    for (std::uint32_t& v : t) {
      // An index out of range stays out of range, for the check to name.
      valid = valid && v < renamed.size();
      v = v < renamed.size() ? renamed[v] : std::numeric_limits<std::uint32_t>::max();
    }
    const bool collapsed = t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
    if (!valid || !collapsed) {
      result.triangles.push_back(t);
    }
  }
  return result;
}

std::vector<std::uint32_t> parts_of(const TriangleMesh& mesh, const std::vector<bool>& kept) {
  std::vector<std::uint32_t> parent(mesh.vertices_m.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) {
      v = parent[v] = parent[parent[v]];
    }
    return v;
  };
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (!kept[i]) {
      continue;
    }
    const auto& t = mesh.triangles[i];
    parent[root(t[1])] = root(t[0]);
    parent[root(t[2])] = root(t[0]);
  }
  std::vector<std::uint32_t> part(kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    part[i] = root(mesh.triangles[i][0]);
  }
  return part;
}

TriangleMesh part_of(const TriangleMesh& mesh, std::span<const std::uint32_t> faces) {
  constexpr auto kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> renamed(mesh.vertices_m.size(), kUnused);
  TriangleMesh part;
  part.triangles.reserve(faces.size());
  for (const std::uint32_t face : faces) {
    std::array<std::uint32_t, 3> t = mesh.triangles[face];
    for (std::uint32_t& v : t) {
      if (renamed[v] == kUnused) {
        renamed[v] = static_cast<std::uint32_t>(part.vertices_m.size());
        part.vertices_m.push_back(mesh.vertices_m[v]);
      }
      v = renamed[v];
    }
    part.triangles.push_back(t);
  }
  return part;
}

MainPart main_part(TriangleMesh mesh) {
  for (const auto& t : mesh.triangles) {
    if (std::max({t[0], t[1], t[2]}) >= mesh.vertices_m.size()) {
      return {std::move(mesh), 0};
    }
  }
  struct Part {
    std::vector<std::uint32_t> faces;
    bool closed = true;
    double volume_m3 = 0.0;
  };
  const std::vector<std::uint32_t> numbers =
      parts_of(mesh, std::vector<bool>(mesh.triangles.size(), true));
  std::map<std::uint32_t, Part> parts;
  for (std::uint32_t face = 0; face < numbers.size(); ++face) {
    parts[numbers[face]].faces.push_back(face);
  }
  if (parts.size() < 2) {
    return {std::move(mesh), 0};
  }
  std::vector<bool> open(mesh.vertices_m.size(), false);
  for_each_edge(sorted_edges(mesh), [&](const DirectedEdge* edge, std::size_t count) {
    if (count != 2) {
      open[edge->low] = true;
    }
  });
  const auto counted_m3 = [](const Part& part) {
    return part.closed ? kOpenIsTheBone * part.volume_m3 : part.volume_m3;
  };
  const Part* main = nullptr;
  for (auto& [number, part] : parts) {
    const TriangleMesh own = part_of(mesh, part.faces);
    part.volume_m3 = std::abs(solid_of(own).volume_m3);
    for (const std::uint32_t face : part.faces) {
      for (const std::uint32_t v : mesh.triangles[face]) {
        part.closed = part.closed && !open[v];
      }
    }
    if (main == nullptr || counted_m3(part) > counted_m3(*main)) {
      main = &part;
    }
  }
  return {part_of(mesh, main->faces), parts.size() - 1};
}

}  // namespace orthonav::nav
