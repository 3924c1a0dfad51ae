#pragma once

#include <array>

#include "render/vulkan/targets.h"

namespace orthonav::render {

/// What a frame is drawn with, in this order.
enum class Stage {
  kBackground,   ///< the image behind everything; colour only
  kDepth,        ///< solids into the depth alone
  kTranslucent,  ///< see-through meshes: the nearest surface replaces what is there
  kSolid,        ///< the nearest solid surface, blended
  kTriangle,
  kLine,  ///< the stencil lets each item touch a sample once
  kText,  ///< in front of everything: a number is never hidden
  kCount
};

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
