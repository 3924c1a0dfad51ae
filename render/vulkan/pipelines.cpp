#include "render/vulkan/pipelines.h"

#include <cstring>
#include <string_view>
#include <vector>

#include "embedded/background_frag.h"
#include "embedded/background_vert.h"
#include "embedded/flat_frag.h"
#include "embedded/label_frag.h"
#include "embedded/line_vert.h"
#include "embedded/mesh_solid_frag.h"
#include "embedded/mesh_veil_frag.h"
#include "embedded/mesh_vert.h"
#include "embedded/text_depth_frag.h"
#include "embedded/text_frag.h"
#include "embedded/text_label_frag.h"
#include "embedded/text_vert.h"
#include "embedded/triangle_vert.h"
#include "render/vulkan/failure.h"
#include "render/vulkan/gpu_types.h"

namespace orthonav::render {
namespace {

/// How a stage differs from the others.
struct Recipe {
  std::string_view vertex;
  std::string_view fragment;  ///< empty: depth alone
  bool mesh = false;          ///< reads vertices
  bool blends = false;
  bool depth_test = false;
  bool depth_write = false;
  VkCompareOp depth_compare = VK_COMPARE_OP_LESS_OR_EQUAL;
  bool stencil = false;
};

/// For the three stages that draw meshes.
Recipe mesh_recipe(std::string_view fragment, bool blends, bool depth_write,
                   VkCompareOp depth_compare) {
  Recipe recipe;
  recipe.vertex = embedded::mesh_vert();
  recipe.fragment = fragment;
  recipe.mesh = recipe.depth_test = true;
  recipe.blends = blends;
  recipe.depth_write = depth_write;
  recipe.depth_compare = depth_compare;
  return recipe;
}

/// For what is drawn over the meshes without hiding anything.
Recipe overlay_recipe(std::string_view vertex, std::string_view fragment, bool depth_test) {
  Recipe recipe;
  recipe.vertex = vertex;
  recipe.fragment = fragment;
  recipe.blends = true;
  recipe.depth_test = depth_test;
  return recipe;
}

Recipe recipe_of(Stage stage, PassKind kind) {
  const bool labels = kind == PassKind::kLabels;
  const std::string_view flat = labels ? embedded::label_frag() : embedded::flat_frag();
  switch (stage) {
    case Stage::kBackground: {
      Recipe recipe;
      recipe.vertex = embedded::background_vert();
      recipe.fragment = embedded::background_frag();
      return recipe;
    }
    case Stage::kDepth:
      return mesh_recipe({}, false, true, VK_COMPARE_OP_LESS);
    case Stage::kTranslucent:
      return mesh_recipe(labels ? flat : embedded::mesh_veil_frag(), false, true,
                         VK_COMPARE_OP_LESS);
    case Stage::kSolid:
      return mesh_recipe(labels ? flat : embedded::mesh_solid_frag(), true, false,
                         VK_COMPARE_OP_EQUAL);
    case Stage::kTriangle:
      return overlay_recipe(embedded::triangle_vert(), flat, true);
    case Stage::kLine: {
      Recipe recipe = overlay_recipe(embedded::line_vert(), flat, true);
      recipe.stencil = true;
      return recipe;
    }
    case Stage::kText:
    case Stage::kCount:
      break;
  }
  return overlay_recipe(embedded::text_vert(),
                        labels ? embedded::text_label_frag() : embedded::text_frag(), false);
}

/// The stage as it is drawn, but for its depth alone; text stands in front of everything.
Recipe depth_recipe_of(Stage stage) {
  Recipe recipe = recipe_of(stage, PassKind::kLabels);
  recipe.fragment = stage == Stage::kText ? embedded::text_depth_frag() : std::string_view{};
  recipe.stencil = false;
  recipe.depth_test = recipe.depth_write = true;
  recipe.depth_compare = stage == Stage::kText ? VK_COMPARE_OP_ALWAYS : VK_COMPARE_OP_LESS;
  return recipe;
}

ShaderModule make_module(VkDevice device, std::string_view spirv) {
  // Embedded bytes have no alignment; SPIR-V consists of words.
  std::vector<std::uint32_t> words(spirv.size() / sizeof(std::uint32_t));
  std::memcpy(words.data(), spirv.data(), words.size() * sizeof(std::uint32_t));
  VkShaderModuleCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  info.codeSize = words.size() * sizeof(std::uint32_t);
  info.pCode = words.data();
  VkShaderModule module = VK_NULL_HANDLE;
  check(vkCreateShaderModule(device, &info, nullptr, &module), "shader");
  return {device, module};
}

VkPipelineColorBlendAttachmentState blend_state(const Recipe& recipe, PassKind kind, Blend blend) {
  VkPipelineColorBlendAttachmentState state = {};
  // Images come out opaque: the clear writes alpha 1 and nothing changes it. Only where someone
  // else puts them over the world does alpha say how much of the world is hidden.
  state.colorWriteMask =
      VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT;
  if (blend == Blend::kPremultiplied) {
    state.colorWriteMask |= VK_COLOR_COMPONENT_A_BIT;
  }
  if (recipe.fragment.empty()) {
    state.colorWriteMask = 0;
  }
  state.blendEnable = recipe.blends && kind == PassKind::kColour;
  state.srcColorBlendFactor = VK_BLEND_FACTOR_ONE;
  state.dstColorBlendFactor =
      blend == Blend::kAdditive ? VK_BLEND_FACTOR_ONE : VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
  state.colorBlendOp = VK_BLEND_OP_ADD;
  state.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
  state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
  state.alphaBlendOp = VK_BLEND_OP_ADD;
  return state;
}

VkPipelineDepthStencilStateCreateInfo depth_state(const Recipe& recipe) {
  VkPipelineDepthStencilStateCreateInfo state = {};
  state.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
  state.depthTestEnable = recipe.depth_test;
  state.depthWriteEnable = recipe.depth_write;
  state.depthCompareOp = recipe.depth_compare;
  state.stencilTestEnable = recipe.stencil;
  state.front.failOp = VK_STENCIL_OP_KEEP;
  state.front.depthFailOp = VK_STENCIL_OP_KEEP;
  state.front.passOp = VK_STENCIL_OP_REPLACE;
  state.front.compareOp = VK_COMPARE_OP_NOT_EQUAL;
  state.front.compareMask = 0xff;
  state.front.writeMask = 0xff;
  state.back = state.front;
  return state;
}

/// The fixed-function states, kept together because they point to one another.
struct States {
  VkVertexInputBindingDescription binding = {0, sizeof(GpuVertex), VK_VERTEX_INPUT_RATE_VERTEX};
  std::array<VkVertexInputAttributeDescription, 3> attributes = {
      {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(GpuVertex, position)},
       {1, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(GpuVertex, normal)},
       {2, 0, VK_FORMAT_R32_SFLOAT, offsetof(GpuVertex, tint)}}};
  VkPipelineVertexInputStateCreateInfo input = {};
  VkPipelineInputAssemblyStateCreateInfo assembly = {};
  VkViewport viewport = {};
  VkPipelineViewportStateCreateInfo viewports = {};
  VkPipelineRasterizationStateCreateInfo raster = {};
  VkPipelineMultisampleStateCreateInfo multisample = {};
  VkPipelineDepthStencilStateCreateInfo depth = {};
  VkPipelineColorBlendAttachmentState attachment = {};
  VkPipelineColorBlendStateCreateInfo blend = {};
  std::array<VkDynamicState, 2> changing = {VK_DYNAMIC_STATE_SCISSOR,
                                            VK_DYNAMIC_STATE_STENCIL_REFERENCE};
  VkPipelineDynamicStateCreateInfo dynamic = {};

  States(const Recipe& recipe, const TargetSpec& target, Blend mode) {
    input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
    if (recipe.mesh) {
      input.vertexBindingDescriptionCount = 1;
      input.pVertexBindingDescriptions = &binding;
      // A depth pipeline runs the same shader and so takes the normals and tints too.
      input.vertexAttributeDescriptionCount = static_cast<std::uint32_t>(attributes.size());
      input.pVertexAttributeDescriptions = attributes.data();
    }
    assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    viewport = {0, 0, static_cast<float>(target.width), static_cast<float>(target.height), 0, 1};
    viewports.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
    viewports.viewportCount = 1;
    viewports.pViewports = &viewport;
    viewports.scissorCount = 1;
    raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    raster.polygonMode = VK_POLYGON_MODE_FILL;
    // Half of a closed surface faces away and never shows.
    raster.cullMode = recipe.mesh ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_NONE;
    raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    raster.lineWidth = 1;
    multisample.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    multisample.rasterizationSamples = target.samples;
    depth = depth_state(recipe);
    attachment = blend_state(recipe, target.kind, mode);
    blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    blend.attachmentCount = target.kind == PassKind::kDepth ? 0 : 1;
    blend.pAttachments = &attachment;
    dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
    dynamic.dynamicStateCount = recipe.stencil ? 2 : 1;
    dynamic.pDynamicStates = changing.data();
  }
  States(const States&) = delete;
  States& operator=(const States&) = delete;
};

VkPipelineShaderStageCreateInfo stage_info(VkShaderStageFlagBits stage, VkShaderModule module) {
  VkPipelineShaderStageCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage = stage;
  info.module = module;
  info.pName = "main";
  return info;
}

Pipeline make_pipeline(const Device& device, VkPipelineCache cache, VkPipelineLayout layout,
                       const Targets& targets, const Recipe& recipe, Blend blend) {
  const ShaderModule vertex = make_module(device.get(), recipe.vertex);
  const ShaderModule fragment =
      recipe.fragment.empty() ? ShaderModule() : make_module(device.get(), recipe.fragment);
  const std::array<VkPipelineShaderStageCreateInfo, 2> stages = {
      stage_info(VK_SHADER_STAGE_VERTEX_BIT, vertex.get()),
      stage_info(VK_SHADER_STAGE_FRAGMENT_BIT, fragment.get())};
  const States states(recipe, targets.spec(), blend);
  VkGraphicsPipelineCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
  info.stageCount = recipe.fragment.empty() ? 1 : 2;
  info.pStages = stages.data();
  info.pVertexInputState = &states.input;
  info.pInputAssemblyState = &states.assembly;
  info.pViewportState = &states.viewports;
  info.pRasterizationState = &states.raster;
  info.pMultisampleState = &states.multisample;
  info.pDepthStencilState = &states.depth;
  info.pColorBlendState = &states.blend;
  info.pDynamicState = &states.dynamic;
  info.layout = layout;
  info.renderPass = targets.pass();
  VkPipeline pipeline = VK_NULL_HANDLE;
  check(vkCreateGraphicsPipelines(device.get(), cache, 1, &info, nullptr, &pipeline), "pipeline");
  return {device.get(), pipeline};
}

}  // namespace

Pipelines::Pipelines(const Device& device, VkPipelineCache cache, VkPipelineLayout layout,
                     const Targets& targets, Blend blend) {
  for (std::size_t i = 0; i < pipelines_.size(); ++i) {
    const auto stage = static_cast<Stage>(i);
    const PassKind kind = targets.spec().kind;
    if (stage == Stage::kBackground && kind != PassKind::kColour) {
      continue;
    }
    const Recipe recipe =
        kind == PassKind::kDepth ? depth_recipe_of(stage) : recipe_of(stage, kind);
    pipelines_[i] = make_pipeline(device, cache, layout, targets, recipe, blend);
  }
}

}  // namespace orthonav::render
