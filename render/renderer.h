#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "base/vulkan_handover.h"
#include "render/scene.h"

namespace orthonav::render {

/// Collects the validation layer's lines. Shared with its readers, so that it outlives the
/// renderer: objects left undestroyed are reported only while the device is destroyed.
using MessageSink = std::shared_ptr<std::vector<std::string>>;

/// Both eyes in one pass, or one after the other; see docs/decisions/0022-both-eyes-in-one-pass.md.
enum class EyesAPass {
  kProbe,  ///< two, if a test frame shows that the device draws them completely
  kOne,
  kTwo  ///< without a test: a faulty driver loses parts of the right eye unnoticed
};

/// How pixels that an edge cuts are drawn.
enum class Edges {
  kCoverage,  ///< how much of a pixel is covered is computed; one sample
  kSamples,   ///< four samples
  kHard       ///< covered if its centre is; the reference for the others
};

struct RendererOptions {
  int width_px = 1268;  ///< of an image that is read back, 16 to 8192
  int height_px = 720;
  Blend blend = Blend::kAdditive;
  /// Blend::kPremultiplied uses four samples instead of coverage, since coverage is kept in alpha.
  Edges edges = Edges::kCoverage;
  /// Part of a device's name ("llvmpipe"); empty: the best GPU, or else lavapipe. A host chooses
  /// its own.
  std::string device;
  bool validation = false;
  MessageSink messages;  ///< empty: the renderer has its own
  EyesAPass eyes_a_pass = EyesAPass::kProbe;
  /// Draws every triangle of prepared surfaces too, from any distance (`prepared`).
  bool every_triangle = false;
  /// Where compiled pipelines are kept for the next start. Not set: the user's cache folder
  /// (XDG_CACHE_HOME or ~/.cache); empty: they are not kept.
  std::optional<std::string> cache_folder;
};

struct DeviceInfo {
  std::string name;
  std::string driver;
  std::string type;  ///< "discrete GPU", "integrated GPU", "CPU", ...
  bool usable = false;
  std::string reason;  ///< why it is not usable
};

/// How the time of one frame splits up, in milliseconds of wall time.
struct FrameTiming {
  double record_ms = 0;  ///< checks, layout, commands
  double submit_ms = 0;  ///< submission to the driver
  double gpu_ms = 0;     ///< from submission to the fence; of a host's frame: the wait for an older
  double read_ms = 0;    ///< into the images
  double total_ms = 0;
};

/// Makes instance and device for a renderer that draws into its images, such as the runtime of a
/// headset. A handle in an answer is never null.
class VulkanHost {
 public:
  virtual ~VulkanHost() = default;
  /// The oldest and the newest version that the host takes.
  [[nodiscard]] virtual std::array<VulkanVersion, 2> versions() const = 0;
  /// A VkInstance as described by a VkInstanceCreateInfo; the renderer destroys it.
  virtual Result<void*> create_instance(VulkanFunction get_instance_proc_addr,
                                        const void* info) = 0;
  /// The VkPhysicalDevice to be used.
  virtual Result<void*> physical_device(void* instance) = 0;
  /// A VkDevice as described by a VkDeviceCreateInfo; the renderer destroys it.
  virtual Result<void*> create_device(void* physical, VulkanFunction get_instance_proc_addr,
                                      const void* info) = 0;
};

/// Draws scenes on a Vulkan device, its own or a host's, into images that are read back or into
/// images that others made on that device. One thread at a time; with a host, the one that the host
/// allows to use the queue. Nothing is thrown; an Error is one line, and the renderer stays usable
/// after it unless its code is kLost: then the device is lost, and every call fails from then on.
class Renderer {
 public:
  /// An Error if the options can't be met or no Vulkan device is suitable.
  static Result<std::unique_ptr<Renderer>> create(const RendererOptions& options);
  /// On the host's device. The host is asked during this call only; its errors are passed on
  /// unchanged.
  static Result<std::unique_ptr<Renderer>> create(const RendererOptions& options, VulkanHost& host);
  virtual ~Renderer() = default;

  /// Draws `scene` for one or two views. `backgrounds` is empty (black) or one image per view of
  /// the renderer's size. Fills one image per view, reusing what `images` holds; after an Error the
  /// images mean nothing.
  virtual Status draw(const Scene& scene, const std::vector<View>& views,
                      const std::vector<const RgbaImage*>& backgrounds,
                      std::vector<RgbaImage>& images) = 0;
  /// The label images of the same scene.
  virtual Status draw_labels(const Scene& scene, const std::vector<View>& views,
                             std::vector<LabelImage>& images) = 0;

  // Into images that others made, two frames at a time: while the device draws one, the next is
  // recorded.

  [[nodiscard]] virtual VulkanObjects objects() const = 0;
  /// How well images of this VkFormat suit: the higher the better; 0 if they can't be drawn into.
  /// sRGB formats are encoded, all others hold linear light.
  [[nodiscard]] virtual int format_score(std::int64_t format) const = 0;
  /// The same for depth images.
  [[nodiscard]] virtual int depth_format_score(std::int64_t format) const = 0;
  /// The images to draw into from now on; they must stay until the next call or `finish`. If
  /// coverage is computed they are also copied from; images of two layers may be copied into.
  virtual Status use(const EyeImages& images) = 0;
  /// Does the slow work that does not need the views: waits for the oldest frame in flight, checks
  /// the scene, uploads new meshes. `draw` of the same scene must follow.
  virtual Status prepare(const Scene& scene) = 0;
  /// Draws `scene` for both eyes into image `indices[i]` of chain i, the chains of depth after the
  /// others, and returns once the frame is submitted. The images are left as colour attachments,
  /// and as depth and stencil attachments.
  virtual Status draw(const Scene& scene, const std::vector<View>& views,
                      std::span<const std::uint32_t> indices, HeadTexts head_texts) = 0;
  /// Draws the texts of `scene` for one view into image `index` of the panel, between frames or
  /// between `prepare` and `draw`, and returns once they are submitted. Colours come out
  /// premultiplied, with their opacity as alpha; on an additive display alpha is 0, so that the
  /// panel is added to what lies below it.
  virtual Status draw_panel(const Scene& scene, const View& view, std::uint32_t index) = 0;
  /// Waits for every frame in flight and releases the images: they may be destroyed.
  virtual Status finish() = 0;

  [[nodiscard]] virtual bool lost() const = 0;
  [[nodiscard]] virtual const DeviceInfo& device() const = 0;
  /// Of the last frame.
  [[nodiscard]] virtual FrameTiming last_timing() const = 0;
  /// What the validation layer has reported so far; empty when there was nothing or it is off.
  [[nodiscard]] virtual const std::vector<std::string>& validation_messages() const = 0;
  /// What was drawn differently than requested, one line each, such as a surface with fewer
  /// triangles.
  [[nodiscard]] virtual const std::vector<std::string>& notes() const = 0;
};

/// Every Vulkan device of this machine, with the reason where one can't be used.
[[nodiscard]] std::vector<DeviceInfo> list_devices();

}  // namespace orthonav::render
