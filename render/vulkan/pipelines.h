#pragma once

#include <array>

#include "render/vulkan/recipes.h"

namespace orthonav::render {

/// One pipeline per stage, for one kind of target.
class Pipelines {
 public:
  /// `cache` may be null.
  Pipelines(const Device& device, VkPipelineCache cache, VkPipelineLayout layout,
            const Targets& targets, Blend blend);
  [[nodiscard]] VkPipeline get(Stage stage) const {
    return pipelines_[static_cast<std::size_t>(stage)].get();
  }

 private:
  std::array<Pipeline, static_cast<std::size_t>(Stage::kCount)> pipelines_;
};

}  // namespace orthonav::render
