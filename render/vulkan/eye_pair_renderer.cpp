#include "render/vulkan/eye_pair_renderer.h"

#include <exception>
#include <utility>

#include "render/vulkan/failure.h"

namespace orthonav::render {
namespace {

Error lost() { return {"renderer: device lost", ErrorCode::kLost}; }

}  // namespace

EyePairRenderer::EyePairRenderer(const RendererOptions& options,
                                 std::unique_ptr<VulkanRenderer> left)
    : options_(options), eyes_{std::move(left), nullptr} {
  options_.eyes_a_pass = EyesAPass::kOne;
}

Status EyePairRenderer::draw(const Scene& scene, const std::vector<View>& views,
                             const std::vector<const RgbaImage*>& backgrounds,
                             std::vector<RgbaImage>& images) {
  if (lost_) {
    return lost();
  }
  if (views.size() == eyes_.size()) {
    const Stopwatch watch;
    timing_ = {};
    const Status drawn = draw_both({scene, views, backgrounds}, images);
    timing_.total_ms = watch.elapsed_ms();
    return remembered(drawn);
  }
  const Status drawn = left().draw(scene, views, backgrounds, images);
  timing_ = left().last_timing();
  return remembered(drawn);
}

Status EyePairRenderer::draw_both(const EyeFrame& frame, std::vector<RgbaImage>& images) {
  try {
    if (!eyes_.back()) {
      eyes_.back() = std::make_unique<VulkanRenderer>(options_);
    }
    images.resize(eyes_.size());
  } catch (const std::exception&) {
    return error_in_flight();
  }
  const Stopwatch watch;
  std::size_t begun = 0;
  Status drawn;
  while (begun < eyes_.size() && drawn) {
    drawn = eyes_[begun]->begin_eye(frame, begun, images[begun]);
    begun += drawn ? 1 : 0;
  }
  const double begun_ms = watch.elapsed_ms();
  // Whatever was begun is awaited, also after an error.
  for (std::size_t eye = 0; eye < begun; ++eye) {
    const Status ended = eyes_[eye]->end_eye(frame, eye, images[eye]);
    drawn = drawn ? ended : drawn;
    timing_.submit_ms += eyes_[eye]->last_timing().submit_ms;
    timing_.read_ms += eyes_[eye]->last_timing().read_ms;
  }
  timing_.record_ms = begun_ms - timing_.submit_ms;
  timing_.gpu_ms = watch.elapsed_ms() - begun_ms - timing_.read_ms;
  return drawn;
}

Status EyePairRenderer::draw_labels(const Scene& scene, const std::vector<View>& views,
                                    std::vector<LabelImage>& images) {
  if (lost_) {
    return lost();
  }
  const Status drawn = left().draw_labels(scene, views, images);
  timing_ = left().last_timing();
  return remembered(drawn);
}

Status EyePairRenderer::remembered(Status drawn) {
  lost_ = lost_ || (!drawn && drawn.error().code == ErrorCode::kLost);
  return drawn;
}

}  // namespace orthonav::render
