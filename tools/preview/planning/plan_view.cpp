#include "tools/preview/planning/plan_view.h"

#include <algorithm>
#include <array>

#include "engine/holograms/shapes/render_values.h"

namespace orthonav::preview {
namespace {

constexpr std::array<std::uint8_t, 4> kEmpty = {24, 27, 31, 255};
constexpr std::array<std::uint8_t, 4> kGap = {70, 75, 82, 255};

std::size_t bytes_of(int width_px, int height_px) {
  return 4u * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
}

}  // namespace

Result<std::unique_ptr<PlanView>> PlanView::create(int width_px, int height_px,
                                                   const std::string& device) {
  render::RendererOptions options;
  options.width_px = width_px / 2;
  options.height_px = height_px / 2;
  options.blend = render::Blend::kOver;
  options.device = device;
  auto renderer = render::Renderer::create(options);
  if (!renderer) {
    return renderer.error();
  }
  return std::unique_ptr<PlanView>(new PlanView(width_px, height_px, std::move(*renderer)));
}

PlanView::PlanView(int width_px, int height_px, std::unique_ptr<render::Renderer> renderer)
    : renderer_(std::move(renderer)), images_(1) {
  picture_ = {width_px, height_px, std::vector<std::uint8_t>(bytes_of(width_px, height_px))};
  behind_ = {width_px / 2, height_px / 2, {}};
  images_[0] = behind_;
  images_[0].pixels.resize(bytes_of(width_px / 2, height_px / 2));
  backgrounds_.assign(1, &behind_);
}

void PlanView::draw_behind(const PlanModel& model, Pane pane) {
  if (scan_ && pane != Pane::kSpace) {
    // Models of a scan lie in its frame.
    engine::draw_slice(*scan_, Transform<engine::Scan, Vertebra>(), model.slice(pane),
                       model.window(), behind_);
    return;
  }
  behind_.pixels.resize(bytes_of(behind_.width_px, behind_.height_px));
  for (std::size_t i = 0; i < behind_.pixels.size(); i += 4) {
    std::copy(kEmpty.begin(), kEmpty.end(), behind_.pixels.begin() + static_cast<long>(i));
  }
}

/// Copies the newest image to its place, with a thin border towards its neighbours.
void PlanView::put(Pane pane) {
  const auto number = static_cast<std::size_t>(pane);
  const RgbaImage& image = images_.front();
  const auto row = 4u * static_cast<std::size_t>(image.width_px);
  const auto height = static_cast<std::size_t>(image.height_px);
  const std::size_t left = (number % 2) * row;
  const std::size_t top = (number / 2) * height;
  for (std::size_t y = 0; y < height; ++y) {
    std::uint8_t* to = &picture_.pixels[(top + y) * 2 * row + left];
    std::copy_n(&image.pixels[y * row], row, to);
    if (number % 2 == 1) {
      std::copy(kGap.begin(), kGap.end(), to);
    }
    if (number / 2 == 1 && y == 0) {
      for (std::size_t x = 0; x < row; x += 4) {
        std::copy(kGap.begin(), kGap.end(), to + x);
      }
    }
  }
}

Status PlanView::draw(const PlanModel& model) {
  const std::size_t level = model.editor().place().level;
  if (!bone_ || bone_->level != level) {
    bone_ = DrawnBone{level, engine::mesh_data(model.editor().level().mesh)};
  }
  for (std::size_t i = 0; i < kPanes; ++i) {
    const auto pane = static_cast<Pane>(i);
    scene_.clear();
    draw_behind(model, pane);
    render::View view;
    if (pane == Pane::kSpace) {
      add_space(model, *bone_, scene_);
      view = view_in_space(model, aspect());
    } else {
      add_slice(model, pane, aspect(), scene_);
      view = view_of(model.slice(pane), aspect());
    }
    if (const Status drawn = renderer_->draw(scene_, {view}, backgrounds_, images_); !drawn) {
      return drawn;
    }
    put(pane);
  }
  return {};
}

}  // namespace orthonav::preview
