#include "render/vulkan/mesh_cache.h"

#include <algorithm>

#include "render/frame/scene_check.h"
#include "render/vulkan/gpu_types.h"

namespace orthonav::render {
namespace {

constexpr int kMaxIdleFrames = 300;  // five seconds of a headset's frames

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

GpuMesh copy_of(const Device& device, Commands& commands, const MeshData& mesh,
                const MeshCache::Options& options) {
  GpuMesh copy;
  copy.box = box_of(mesh);
  if (mesh.indices.empty()) {
    return copy;
  }
  std::vector<std::uint32_t> all;
  const auto add = [&](const std::vector<std::uint32_t>& indices, float error) {
    copy.levels.push_back({static_cast<std::uint32_t>(all.size()),
                           static_cast<std::uint32_t>(indices.size()), error,
                           options.edges ? SurfaceEdges(mesh, indices) : SurfaceEdges()});
    all.insert(all.end(), indices.begin(), indices.end());
  };
  if (mesh.levels.empty() || options.every_triangle) {
    add(mesh.indices, 0);
  } else {
    for (const MeshLevel& level : mesh.levels) {
      add(level.indices, level.error);
    }
  }
  const std::vector<GpuVertex> vertices = vertices_of(mesh);
  copy.vertices = uploaded(device, commands, vertices.data(), vertices.size() * sizeof(GpuVertex),
                           VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  copy.indices = uploaded(device, commands, all.data(), all.size() * sizeof(std::uint32_t),
                          VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
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
                      const std::shared_ptr<const MeshData>& mesh) {
  if (const Status checked = check_mesh(*mesh); !checked) {
    return checked;
  }
  Entry entry;
  entry.address = mesh.get();
  entry.mesh = mesh;
  entry.copy = copy_of(device, commands, *mesh, options_);
  entries_.push_back(std::move(entry));
  return {};
}

void MeshCache::end_frame() {
  for (Entry& entry : entries_) {
    ++entry.idle_frames;
  }
  std::erase_if(entries_, [](const Entry& entry) {
    return entry.idle_frames > 1 && (entry.mesh.expired() || entry.idle_frames > kMaxIdleFrames);
  });
}

}  // namespace orthonav::render
