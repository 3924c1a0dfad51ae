#pragma once

#include <memory>
#include <vector>

#include "base/result.h"
#include "render/frame/screen_bounds.h"
#include "render/frame/surface_edges.h"
#include "render/vulkan/commands.h"
#include "render/vulkan/memory.h"

namespace orthonav::render {

/// The copy of a mesh on the device.
struct GpuMesh {
  struct Level {
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0;
    float error = 0;     ///< as in MeshLevel
    SurfaceEdges edges;  ///< where they are wanted
  };
  Box box;
  Buffer vertices;
  Buffer indices;             ///< of all levels
  std::vector<Level> levels;  ///< finest first; an empty mesh has none, and draws nothing

  /// The coarsest level whose error is no larger than this, or else the finest.
  [[nodiscard]] std::size_t level_within(float error) const;
};

/// Device copies of meshes, keyed by pointer. A copy is dropped when nobody holds the mesh any
/// more, or when it was not drawn for a while.
class MeshCache {
 public:
  /// What is wanted of every mesh.
  struct Options {
    bool edges = false;
    bool every_triangle = false;  ///< the mesh as given, not its levels
  };
  MeshCache() : MeshCache(Options{}) {}
  explicit MeshCache(const Options& options) : options_(options) {}

  /// The copy of a mesh, or nullptr.
  [[nodiscard]] const GpuMesh* find(const std::shared_ptr<const MeshData>& mesh) const;
  /// Checks and uploads a mesh that has no copy yet. Throws Failure where the device fails.
  [[nodiscard]] Status add(const Device& device, Commands& commands,
                           const std::shared_ptr<const MeshData>& mesh);
  /// Marks the frame's end: drops what was used neither in this frame nor in the one before, which
  /// the device may still draw.
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
  Options options_;
  std::vector<Entry> entries_;
};

}  // namespace orthonav::render
