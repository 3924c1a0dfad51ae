#pragma once

#include <string_view>

#include "render/vulkan/targets.h"

namespace orthonav::render {

/// The stages of drawing a frame, in this order.
enum class Stage {
  kBackground,      ///< the image behind everything; colour only
  kDepth,           ///< solids into the depth alone
  kTranslucent,     ///< see-through meshes: the nearest surface replaces what was drawn before
  kOverBackground,  ///< the same where there is a background to shine through
  kFarthest,        ///< nothing but the farthest depth, where veils were: they hide nothing else
  kSolid,           ///< the nearest solid surface, blended
  kTriangle,
  kLine,        ///< the stencil lets each item touch a sample once
  kLineCover,   ///< replaces kLine where coverage is computed: a line into alpha, then
  kLineColour,  ///< its colour by what alpha lacks, along its segments or
  kLineFill,    ///< over everything around it
  kEdge,        ///< of meshes, where coverage is computed: pixels get their neighbours' share
  kText,        ///< in front of everything: a number is never hidden
  kCount
};

/// How a stage's colour is combined with the existing one.
enum class Mix {
  kReplace,
  kBlend,       ///< as the frame's Blend says
  kCoverAlpha,  ///< the smallest alpha is kept, colour is unchanged
  kByAlpha      ///< weighted by what alpha lacks; alpha becomes full
};

/// How a stage differs from the others.
struct Recipe {
  std::string_view vertex;
  std::string_view fragment;  ///< empty: depth alone
  bool mesh = false;          ///< reads vertices
  Mix mix = Mix::kReplace;
  bool depth_test = false;
  bool depth_write = false;
  VkCompareOp depth_compare = VK_COMPARE_OP_LESS_OR_EQUAL;
  bool stencil = false;
  bool has_background = false;  ///< for the shader, as the next
  bool mean_light = false;      ///< of a rim over each pixel, not the light at its centre
};

/// Whether frames of this kind have the stage.
[[nodiscard]] bool has_stage(Stage stage, const TargetSpec& spec);
[[nodiscard]] Recipe recipe_of(Stage stage, const TargetSpec& spec);

}  // namespace orthonav::render
