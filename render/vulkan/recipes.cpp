#include "render/vulkan/recipes.h"

#include "embedded/background_frag.h"
#include "embedded/background_vert.h"
#include "embedded/edge_frag.h"
#include "embedded/edge_vert.h"
#include "embedded/flat_frag.h"
#include "embedded/label_frag.h"
#include "embedded/line_colour_frag.h"
#include "embedded/line_cover_frag.h"
#include "embedded/line_cover_vert.h"
#include "embedded/line_vert.h"
#include "embedded/mesh_solid_frag.h"
#include "embedded/mesh_veil_frag.h"
#include "embedded/mesh_vert.h"
#include "embedded/text_depth_frag.h"
#include "embedded/text_frag.h"
#include "embedded/text_label_frag.h"
#include "embedded/text_vert.h"
#include "embedded/triangle_cover_frag.h"
#include "embedded/triangle_cover_vert.h"
#include "embedded/triangle_vert.h"

namespace orthonav::render {
namespace {

/// For the three stages that draw meshes.
Recipe mesh_recipe(std::string_view fragment, Mix mix, bool depth_write,
                   VkCompareOp depth_compare) {
  Recipe recipe;
  recipe.vertex = embedded::mesh_vert();
  recipe.fragment = fragment;
  recipe.mesh = recipe.depth_test = true;
  recipe.mix = mix;
  recipe.depth_write = depth_write;
  recipe.depth_compare = depth_compare;
  return recipe;
}

/// For stages that are drawn over the meshes without hiding anything.
Recipe overlay_recipe(std::string_view vertex, std::string_view fragment, bool depth_test) {
  Recipe recipe;
  recipe.vertex = vertex;
  recipe.fragment = fragment;
  recipe.mix = Mix::kBlend;
  recipe.depth_test = depth_test;
  return recipe;
}

/// For stages that cover pixels regardless of depth.
Recipe plain_recipe(std::string_view vertex, std::string_view fragment) {
  Recipe recipe;
  recipe.vertex = vertex;
  recipe.fragment = fragment;
  return recipe;
}

/// A stage of a line drawn with computed coverage; all such stages use the same geometry.
Recipe covered_line_recipe(std::string_view fragment, Mix mix) {
  Recipe recipe = overlay_recipe(embedded::line_cover_vert(), fragment, true);
  recipe.mix = mix;
  return recipe;
}

/// A line's colour over all its surroundings; its coverage is in the alpha already.
Recipe line_fill_recipe() {
  Recipe recipe = plain_recipe(embedded::background_vert(), embedded::line_colour_frag());
  recipe.mix = Mix::kByAlpha;
  return recipe;
}

/// Draws the greatest depth, which llvmpipe does faster than clearing it.
Recipe farthest_recipe() {
  Recipe recipe = plain_recipe(embedded::background_vert(), {});
  recipe.depth_test = recipe.depth_write = true;
  recipe.depth_compare = VK_COMPARE_OP_ALWAYS;
  return recipe;
}

/// Of several edges in one pixel the nearest counts; the shader chooses the depth.
Recipe edge_recipe() {
  Recipe recipe = plain_recipe(embedded::edge_vert(), embedded::edge_frag());
  recipe.depth_test = recipe.depth_write = true;
  return recipe;
}

Recipe over_background(Recipe recipe) {
  recipe.has_background = true;
  return recipe;
}

/// `covers`: whether the coverage of pixels is computed.
Recipe recipe_of(Stage stage, bool labels, bool covers) {
  const std::string_view flat = labels ? embedded::label_frag() : embedded::flat_frag();
  switch (stage) {
    case Stage::kBackground:
      return plain_recipe(embedded::background_vert(), embedded::background_frag());
    case Stage::kDepth:
      return mesh_recipe({}, Mix::kReplace, true, VK_COMPARE_OP_LESS);
    case Stage::kTranslucent:
      return mesh_recipe(labels ? flat : embedded::mesh_veil_frag(), Mix::kReplace, true,
                         VK_COMPARE_OP_LESS);
    case Stage::kOverBackground:
      return over_background(recipe_of(Stage::kTranslucent, labels, covers));
    case Stage::kSolid:
      return mesh_recipe(labels ? flat : embedded::mesh_solid_frag(), Mix::kBlend, false,
                         VK_COMPARE_OP_EQUAL);
    case Stage::kFarthest:
      return farthest_recipe();
    case Stage::kTriangle:
      return covers ? overlay_recipe(embedded::triangle_cover_vert(),
                                     embedded::triangle_cover_frag(), true)
                    : overlay_recipe(embedded::triangle_vert(), flat, true);
    case Stage::kLine: {
      Recipe recipe = overlay_recipe(embedded::line_vert(), flat, true);
      recipe.stencil = true;
      return recipe;
    }
    case Stage::kLineCover:
      return covered_line_recipe(embedded::line_cover_frag(), Mix::kCoverAlpha);
    case Stage::kLineColour:
      return covered_line_recipe(embedded::line_colour_frag(), Mix::kByAlpha);
    case Stage::kLineFill:
      return line_fill_recipe();
    case Stage::kEdge:
      return edge_recipe();
    case Stage::kText:
    case Stage::kCount:
      break;
  }
  return overlay_recipe(embedded::text_vert(),
                        labels ? embedded::text_label_frag() : embedded::text_frag(), false);
}

/// The stage as it is drawn for depth only; text is in front of everything.
Recipe depth_recipe_of(Stage stage) {
  Recipe recipe = recipe_of(stage, true, false);
  recipe.fragment = stage == Stage::kText ? embedded::text_depth_frag() : std::string_view{};
  recipe.stencil = false;
  recipe.depth_test = recipe.depth_write = true;
  recipe.depth_compare = stage == Stage::kText ? VK_COMPARE_OP_ALWAYS : VK_COMPARE_OP_LESS;
  return recipe;
}

}  // namespace

bool has_stage(Stage stage, const TargetSpec& spec) {
  switch (stage) {
    case Stage::kBackground:
    case Stage::kOverBackground:
      return spec.kind == PassKind::kColour;
    case Stage::kLineCover:
    case Stage::kLineColour:
    case Stage::kLineFill:
    case Stage::kEdge:
      return spec.covers();
    case Stage::kLine:
      return !spec.covers();
    case Stage::kFarthest:
      return spec.kind != PassKind::kDepth;
    case Stage::kDepth:
    case Stage::kTranslucent:
    case Stage::kSolid:
    case Stage::kTriangle:
    case Stage::kText:
      return true;
    case Stage::kCount:
      break;
  }
  return false;
}

Recipe recipe_of(Stage stage, const TargetSpec& spec) {
  if (spec.kind == PassKind::kDepth) {
    return depth_recipe_of(stage);
  }
  Recipe recipe = recipe_of(stage, spec.kind == PassKind::kLabels, spec.covers());
  recipe.mean_light = spec.edges != Edges::kHard;
  return recipe;
}

}  // namespace orthonav::render
