#pragma once

#include <cstddef>
#include <string>

#include "render/vulkan/device.h"
#include "render/vulkan/handle.h"

namespace orthonav::render {

/// This user's cache folder: orthonav in XDG_CACHE_HOME or in ~/.cache; empty if neither is known.
[[nodiscard]] std::string user_cache_folder();

/// Compiled pipelines, kept in a file of the folder from one start to the next. A file that is
/// missing, truncated, changed, or of another device or driver is ignored, and a failure to write
/// is ignored too: a cache is never a reason to fail.
class PipelineCache {
 public:
  /// An empty folder: nothing is read or written.
  PipelineCache(const Device& device, VkPhysicalDevice physical, const std::string& folder);
  /// Writes the file if pipelines were added.
  ~PipelineCache();
  PipelineCache(const PipelineCache&) = delete;
  PipelineCache& operator=(const PipelineCache&) = delete;

  [[nodiscard]] VkPipelineCache get() const { return cache_.get(); }
  /// For this device and driver; empty without a folder.
  [[nodiscard]] const std::string& path() const { return path_; }
  /// Whether a file was found and used.
  [[nodiscard]] bool was_read() const { return read_bytes_ > 0; }

 private:
  void save() const;

  VkDevice device_;
  PipelineCacheHandle cache_;
  std::string path_;
  std::size_t read_bytes_ = 0;
};

}  // namespace orthonav::render
