#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/result.h"
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
  int width_px = 1268;  ///< of one eye, 16 to 8192
  int height_px = 720;
  Blend blend = Blend::kAdditive;
  /// Blend::kPremultiplied uses four samples instead of coverage, since coverage is kept in alpha.
  Edges edges = Edges::kCoverage;
  std::string
      device;  ///< part of a device's name ("llvmpipe"); empty: the best GPU, or else lavapipe
  bool validation = false;
  MessageSink messages;  ///< empty: the renderer has its own
  EyesAPass eyes_a_pass = EyesAPass::kProbe;
  /// Surfaces of many triangles are drawn with fewer where the error is no larger than this mean
  /// over triangles (single points may be four times as far off); 0: every triangle. Surfaces too
  /// large to be drawn at all are simplified even then, with a note. Unless it is 0, surfaces far
  /// away are drawn with fewer triangles still (docs/rendering.md).
  float surface_error_m = 2e-5f;
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
  double gpu_ms = 0;     ///< from submission to the fence
  double read_ms = 0;    ///< into the images
  double total_ms = 0;
};

/// Draws scenes into images. Owns a Vulkan device; one thread at a time. Nothing is thrown; an
/// Error is one line, and the renderer stays usable after it unless its code is kLost: then the
/// device is lost, and every call fails from then on.
class Renderer {
 public:
  /// An Error if the options can't be met or no Vulkan device is suitable.
  static Result<std::unique_ptr<Renderer>> create(const RendererOptions& options);
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
  [[nodiscard]] virtual const DeviceInfo& device() const = 0;
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
