#include "render/vulkan/eye_images.h"

#include <algorithm>
#include <string>

namespace orthonav::render {

std::vector<VkImage> outer_images(const std::vector<std::vector<std::uint64_t>>& chains) {
  std::vector<VkImage> outer;
  for (const auto& chain : chains) {
    for (const std::uint64_t image : chain) {
      outer.push_back(reinterpret_cast<VkImage>(image));
    }
  }
  return outer;
}

Status check_shape(const EyeImages& images, std::uint32_t most_px) {
  const std::string size =
      std::to_string(images.width_px) + "x" + std::to_string(images.height_px) + " px";
  const auto fits = [most_px](int width_px, int height_px) {
    return width_px >= 1 && height_px >= 1 &&
           static_cast<std::uint32_t>(std::max(width_px, height_px)) <= most_px;
  };
  if (!fits(images.width_px, images.height_px)) {
    return Error{"renderer: host's images of " + size + ", limit " + std::to_string(most_px) +
                 " px"};
  }
  const PanelImages& panel = images.panel;
  if (!panel.chain.empty() && !fits(panel.width_px, panel.height_px)) {
    return Error{"renderer: host's panel of " + std::to_string(panel.width_px) + "x" +
                 std::to_string(panel.height_px) + " px, limit " + std::to_string(most_px) + " px"};
  }
  const std::size_t chains = images.layers == 2 ? 1 : 2;
  if (images.layers < 1 || images.layers > 2 || images.chains.size() != chains) {
    return Error{"renderer: host's images have " + std::to_string(images.layers) + " layers in " +
                 std::to_string(images.chains.size()) + " chains; needs 2 in 1 or 1 in 2"};
  }
  if (!images.depth_chains.empty() && images.depth_chains.size() != chains) {
    return Error{"renderer: " + std::to_string(images.depth_chains.size()) +
                 " chains of depth images beside " + std::to_string(chains)};
  }
  for (const auto* all : {&images.chains, &images.depth_chains}) {
    for (const auto& chain : *all) {
      if (chain.empty() || chain.size() != all->front().size()) {
        return Error{"renderer: a chain of " + std::to_string(chain.size()) +
                     " images beside one of " + std::to_string(all->front().size())};
      }
    }
  }
  return {};
}

bool holds(const EyeImages& images, std::span<const std::uint32_t> indices) {
  const std::size_t chains = images.chains.size();
  if (indices.size() != chains + images.depth_chains.size()) {
    return false;
  }
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const auto& chain = i < chains ? images.chains[i] : images.depth_chains[i - chains];
    if (indices[i] >= chain.size()) {
      return false;
    }
  }
  return true;
}

}  // namespace orthonav::render
