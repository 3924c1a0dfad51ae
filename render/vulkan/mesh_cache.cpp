#include "render/vulkan/mesh_cache.h"

#include <algorithm>

#include "render/decimated.h"
#include "render/frame/scene_check.h"
#include "render/vulkan/gpu_types.h"

namespace orthonav::render {
namespace {

constexpr int kMaxIdleFrames = 300;        // five seconds of a headset's frames
constexpr std::size_t kFewTriangles = 64;  // fewer cost next to nothing
constexpr double kWorthwhile = 0.85;       // of the triangles of the level before

std::vector<GpuVertex> vertices_of(const MeshData& mesh) {
  std::vector<GpuVertex> vertices(mesh.positions.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    vertices[i] = {mesh.positions[i], mesh.normals[i], mesh.tints.empty() ? 0 : mesh.tints[i]};
  }
  return vertices;
}

/// Through a staging buffer into the device's memory.
Buffer uploaded(const Device& device, Commands& commands, const void* bytes, std::size_t count,
                VkBufferUsageFlags usage) {
  const Buffer staging(device, count, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, BufferPlace::kUpload);
  staging.write(bytes, count);
  Buffer buffer(device, count, usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT, BufferPlace::kDevice);
  const VkCommandBuffer batch = commands.begin();
  const VkBufferCopy region = {0, 0, count};
  vkCmdCopyBuffer(batch, staging.get(), buffer.get(), 1, &region);
  VkMemoryBarrier readable = {};
  readable.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  readable.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  readable.dstAccessMask = VK_ACCESS_VERTEX_ATTRIBUTE_READ_BIT | VK_ACCESS_INDEX_READ_BIT;
  vkCmdPipelineBarrier(batch, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_VERTEX_INPUT_BIT, 0,
                       1, &readable, 0, nullptr, 0, nullptr);
  commands.run();
  return buffer;
}

MeshLevel level_of(const Device& device, Commands& commands, const MeshData& mesh, bool edges) {
  MeshLevel level;
  level.index_count = static_cast<std::uint32_t>(mesh.indices.size());
  const std::vector<GpuVertex> vertices = vertices_of(mesh);
  if (edges) {
    level.edges = SurfaceEdges(mesh);
  }
  level.vertices = uploaded(device, commands, vertices.data(), vertices.size() * sizeof(GpuVertex),
                            VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  level.indices =
      uploaded(device, commands, mesh.indices.data(), mesh.indices.size() * sizeof(std::uint32_t),
               VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
  return level;
}

/// The mesh as it is drawn from nearby.
MeshData finest_of(const MeshData& mesh, const MeshDetail& detail) {
  return mesh.indices.size() > 3 * detail.enough_triangles
             ? decimated(simplified(mesh, detail.enough_triangles, detail.error),
                         detail.most_triangles)
             : mesh;
}

/// For views from farther away. Errors are those from the mesh as given.
void add_coarser(const Device& device, Commands& commands, const MeshData& mesh,
                 const MeshDetail& detail, std::vector<MeshLevel>& levels) {
  const std::size_t finest = levels.front().index_count / 3;
  const bool large = mesh.indices.size() > 3 * detail.enough_triangles;
  for (const double share : {0.7, 0.5, 0.3}) {
    const auto wanted = static_cast<std::size_t>(share * static_cast<double>(finest));
    const Coarser fewer = wanted < kFewTriangles ? Coarser{} : coarser(mesh, wanted, large);
    if (fewer.mesh.indices.empty() ||
        static_cast<double>(fewer.mesh.indices.size()) > kWorthwhile * levels.back().index_count) {
      return;
    }
    levels.push_back(level_of(device, commands, fewer.mesh, detail.edges));
    levels.back().error = fewer.error_m;
  }
}

GpuMesh copy_of(const Device& device, Commands& commands, const MeshData& mesh,
                const MeshDetail& detail) {
  GpuMesh copy;
  copy.box = box_of(mesh);
  const MeshData finest = finest_of(mesh, detail);
  if (finest.indices.empty()) {
    return copy;
  }
  copy.levels.push_back(level_of(device, commands, finest, detail.edges));
  if (detail.error > 0) {
    add_coarser(device, commands, mesh, detail, copy.levels);
  }
  return copy;
}

}  // namespace

std::size_t GpuMesh::level_within(float error) const {
  std::size_t level = 0;
  while (level + 1 < levels.size() && levels[level + 1].error <= error) {
    ++level;
  }
  return level;
}

bool MeshCache::Entry::is_of(const std::shared_ptr<const MeshData>& other) const {
  return address == other.get() && !mesh.owner_before(other) && !other.owner_before(mesh);
}

const GpuMesh* MeshCache::find(const std::shared_ptr<const MeshData>& mesh) const {
  for (const Entry& entry : entries_) {
    if (entry.is_of(mesh)) {
      return &entry.copy;
    }
  }
  return nullptr;
}

bool MeshCache::touch(const std::shared_ptr<const MeshData>& mesh) {
  for (Entry& entry : entries_) {
    if (!entry.is_of(mesh)) {
      continue;
    }
    entry.idle_frames = 0;
    return true;
  }
  return false;
}

Status MeshCache::add(const Device& device, Commands& commands,
                      const std::shared_ptr<const MeshData>& mesh, const MeshDetail& detail) {
  if (const Status checked = check_mesh(*mesh); !checked) {
    return checked;
  }
  Entry entry;
  entry.address = mesh.get();
  entry.mesh = mesh;
  entry.copy = copy_of(device, commands, *mesh, detail);
  entries_.push_back(std::move(entry));
  return {};
}

void MeshCache::end_frame() {
  for (Entry& entry : entries_) {
    ++entry.idle_frames;
  }
  std::erase_if(entries_, [this](const Entry& entry) {
    const bool drawing = entry.idle_frames <= frames_in_flight_;
    return !drawing && (entry.mesh.expired() || entry.idle_frames > kMaxIdleFrames);
  });
}

}  // namespace orthonav::render
