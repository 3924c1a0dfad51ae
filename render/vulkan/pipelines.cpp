#include "render/vulkan/pipelines.h"

#include <array>
#include <cstddef>
#include <cstring>
#include <string_view>
#include <vector>

#include "render/vulkan/failure.h"
#include "render/vulkan/gpu_types.h"

namespace orthonav::render {
namespace {

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
  // Images are opaque: the clear writes alpha 1 and nothing changes it. Only where the host puts
  // them over the world does alpha say how much of the world is hidden.
  state.colorWriteMask =
      VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT;
  if (blend == Blend::kPremultiplied) {
    state.colorWriteMask |= VK_COLOR_COMPONENT_A_BIT;
  }
  if (recipe.fragment.empty()) {
    state.colorWriteMask = 0;
  }
  state.blendEnable = recipe.mix != Mix::kReplace && kind == PassKind::kColour;
  state.srcColorBlendFactor = VK_BLEND_FACTOR_ONE;
  state.dstColorBlendFactor =
      blend == Blend::kAdditive ? VK_BLEND_FACTOR_ONE : VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
  state.colorBlendOp = VK_BLEND_OP_ADD;
  state.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
  state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
  state.alphaBlendOp = VK_BLEND_OP_ADD;
  if (recipe.mix == Mix::kCoverAlpha) {
    state.colorWriteMask = VK_COLOR_COMPONENT_A_BIT;
    state.alphaBlendOp = VK_BLEND_OP_MIN;
  }
  if (recipe.mix == Mix::kByAlpha) {
    state.colorWriteMask |= VK_COLOR_COMPONENT_A_BIT;
    state.srcColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_DST_ALPHA;
    state.dstColorBlendFactor =
        blend == Blend::kAdditive ? VK_BLEND_FACTOR_ONE : VK_BLEND_FACTOR_DST_ALPHA;
    state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ZERO;
  }
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
      // A depth pipeline runs the same shader, so it takes normals and tints too.
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
    multisample.rasterizationSamples = target.samples();
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

/// The constants of the fragment shaders; those without constants take no notice.
struct ShaderConstants {
  VkBool32 has_background = VK_FALSE;
  VkBool32 mean_light = VK_FALSE;
};
constexpr std::array<VkSpecializationMapEntry, 2> kConstants = {
    {{0, offsetof(ShaderConstants, has_background), sizeof(VkBool32)},
     {1, offsetof(ShaderConstants, mean_light), sizeof(VkBool32)}}};

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
  const ShaderConstants values = {recipe.has_background, recipe.mean_light};
  const VkSpecializationInfo constants = {kConstants.size(), kConstants.data(), sizeof(values),
                                          &values};
  std::array<VkPipelineShaderStageCreateInfo, 2> stages = {
      stage_info(VK_SHADER_STAGE_VERTEX_BIT, vertex.get()),
      stage_info(VK_SHADER_STAGE_FRAGMENT_BIT, fragment.get())};
  stages[1].pSpecializationInfo = &constants;
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
    if (has_stage(stage, targets.spec())) {
      pipelines_[i] =
          make_pipeline(device, cache, layout, targets, recipe_of(stage, targets.spec()), blend);
    }
  }
}

}  // namespace orthonav::render
