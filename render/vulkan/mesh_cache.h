#pragma once

#include <memory>
#include <vector>

#include "base/result.h"
#include "render/frame/screen_bounds.h"
#include "render/frame/surface_edges.h"
#include "render/renderer.h"
#include "render/vulkan/commands.h"
#include "render/vulkan/memory.h"

namespace orthonav::render {

/// How finely a mesh is drawn. Lengths are in the mesh's own unit.
struct MeshDetail {
  float error = 0;  ///< allowed for leaving triangles out whatever the view; 0: all stay, always
  std::size_t enough_triangles = 14'000;  ///< with fewer, simplifying does not pay
  std::size_t most_triangles = 250'000;   ///< regardless of the error
  bool edges = false;                     ///< whether they are wanted
};

/// A mesh on the device, with some number of triangles.
struct MeshLevel {
  Buffer vertices;
  Buffer indices;
  std::uint32_t index_count = 0;
  float error = 0;     ///< how far its surface is off, mean over triangles, in the mesh's own unit
  SurfaceEdges edges;  ///< where they are wanted
};

/// The copy of a mesh on the device.
struct GpuMesh {
  Box box;
  std::vector<MeshLevel> levels;  ///< finest first; an empty mesh has none, and draws nothing

  /// The coarsest level whose error is no larger than this, or else the finest.
  [[nodiscard]] std::size_t level_within(float error) const;
};

/// Device copies of meshes, keyed by pointer. A copy is dropped when nobody holds the mesh any
/// more, or when it was not drawn for a while.
class MeshCache {
 public:
  /// `frames_in_flight`: how many may still be drawing when a frame ends; their copies are not
  /// dropped.
  explicit MeshCache(int frames_in_flight = 0) : frames_in_flight_(frames_in_flight) {}
  /// The copy of a mesh, or nullptr.
  [[nodiscard]] const GpuMesh* find(const std::shared_ptr<const MeshData>& mesh) const;
  /// Checks and uploads a mesh that has no copy yet, with as many triangles as `detail` asks for.
  /// Throws Failure where the device fails.
  [[nodiscard]] Status add(const Device& device, Commands& commands,
                           const std::shared_ptr<const MeshData>& mesh,
                           const MeshDetail& detail = {});
  /// Marks the frame's end: drops what is unused.
  void end_frame();
  /// Marks a mesh as used in this frame; false when it has no copy yet.
  bool touch(const std::shared_ptr<const MeshData>& mesh);
  [[nodiscard]] std::size_t size() const { return entries_.size(); }

 private:
  struct Entry {
    /// Not of a new mesh that lies at the address of an old one.
    [[nodiscard]] bool is_of(const std::shared_ptr<const MeshData>& other) const;

    const MeshData* address = nullptr;
    std::weak_ptr<const MeshData> mesh;
    GpuMesh copy;
    int idle_frames = 0;
  };
  int frames_in_flight_;
  std::vector<Entry> entries_;
};

}  // namespace orthonav::render
