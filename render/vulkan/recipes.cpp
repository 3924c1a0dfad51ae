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

/// For what is drawn over the meshes without hiding anything.
Recipe overlay_recipe(std::string_view vertex, std::string_view fragment, bool depth_test) {
  Recipe recipe;
  recipe.vertex = vertex;
  recipe.fragment = fragment;
  recipe.mix = Mix::kBlend;
  recipe.depth_test = depth_test;
  return recipe;
}

/// The stages that only frames with computed coverage have, and kTriangle of these.
Recipe cover_recipe_of(Stage stage) {
  switch (stage) {
    case Stage::kEdge: {
      Recipe recipe;
      recipe.vertex = embedded::edge_vert();
      recipe.fragment = embedded::edge_frag();
      return recipe;
    }
    case Stage::kLineCover:
    case Stage::kLineColour: {
      const bool cover = stage == Stage::kLineCover;
      Recipe recipe =
          overlay_recipe(embedded::line_cover_vert(),
                         cover ? embedded::line_cover_frag() : embedded::line_colour_frag(), true);
      recipe.mix = cover ? Mix::kCoverAlpha : Mix::kByAlpha;
      return recipe;
    }
    default:
      return overlay_recipe(embedded::triangle_cover_vert(), embedded::triangle_cover_frag(), true);
  }
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
      return mesh_recipe({}, Mix::kReplace, true, VK_COMPARE_OP_LESS);
    case Stage::kTranslucent:
      return mesh_recipe(labels ? flat : embedded::mesh_veil_frag(), Mix::kReplace, true,
                         VK_COMPARE_OP_LESS);
    case Stage::kSolid:
      return mesh_recipe(labels ? flat : embedded::mesh_solid_frag(), Mix::kBlend, false,
                         VK_COMPARE_OP_EQUAL);
    case Stage::kTriangle:
      return overlay_recipe(embedded::triangle_vert(), flat, true);
    case Stage::kLine: {
      Recipe recipe = overlay_recipe(embedded::line_vert(), flat, true);
      recipe.stencil = true;
      return recipe;
    }
    case Stage::kEdge:
    case Stage::kLineCover:
    case Stage::kLineColour:
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

}  // namespace

bool has_stage(Stage stage, const TargetSpec& spec) {
  const bool covers = spec.covers();
  switch (stage) {
    case Stage::kBackground:
      return spec.kind == PassKind::kColour;
    case Stage::kEdge:
    case Stage::kLineCover:
    case Stage::kLineColour:
      return covers;
    case Stage::kLine:
      return !covers;
    default:
      return true;
  }
}

Recipe recipe_of(Stage stage, const TargetSpec& spec) {
  if (spec.kind == PassKind::kDepth) {
    return depth_recipe_of(stage);
  }
  const bool covered = stage == Stage::kTriangle || stage == Stage::kEdge ||
                       stage == Stage::kLineCover || stage == Stage::kLineColour;
  return spec.covers() && covered ? cover_recipe_of(stage) : recipe_of(stage, spec.kind);
}

}  // namespace orthonav::render
