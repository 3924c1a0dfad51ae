#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "base/transform.h"
#include "bench/other_camera.h"
#include "bench/other_texture.h"

// A renderer that shares nothing with hal/sim, to show whether a method is tuned to that one. It
// gathers light ray by ray, 8×8 rays per pixel where tags are, and blurs it by a kernel that is
// summed numerically.
namespace orthonav::bench {

struct PrintedTag {
  int id = 0;  ///< of tag36h11
  double size_m = 0.0;
  double margin_cells = 1.25;  ///< of white paper around it
};

/// A tag with the cells within the outer edge of its border, row 0 on top, from the library's code.
struct DrawnTag {
  PrintedTag print;
  std::array<bool, 64> white{};
};

/// Something as thick as a finger, a capsule.
struct Finger {
  Point<World> from;
  Point<World> to;
  double radius_m = 0.008;
};

/// Where everything is at one moment.
struct Moment {
  Transform<World, Rig> world_from_rig;
  std::vector<Transform<World, Marker>> world_from_marker;
  std::optional<Finger> finger;
};

enum class Blur {
  kNone,  ///< only the pixel's own square, which every picture has
  kDisk,  ///< defocus
  kGaussian
};

struct Optics {
  Blur blur = Blur::kNone;
  double blur_px = 0.0;     ///< the disk's radius, or the Gaussian's SD
  double vignetting = 0.0;  ///< fraction of light lost in the corner
};

struct Lighting {
  Point<World> lamp{{0.25, 0.5, 0.3}};
  double exposure = 0.8;    ///< of white at 0.5 m that faces the lamp; 1 saturates
  double ambient = 0.35;    ///< fraction of the light that has no direction
  double highlight = 0.0;   ///< the most that glossy paper mirrors, in the unit of `exposure`
  double gloss_rad = 0.12;  ///< SD of the highlight's lobe
};

/// Linear light before noise; 1 saturates a pixel.
struct LightImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> light;
};

class OtherRenderer {
 public:
  OtherRenderer(std::span<const PrintedTag> tags, const Optics& optics, const Lighting& lighting,
                std::uint64_t seed);

  /// The mean over moments spread evenly over the exposure. Away from the tags, the background and
  /// the finger are drawn once, at the middle moment, with one ray per pixel.
  void render(std::span<const Moment> moments, const RayGrid& rays,
              const Transform<LeftCamera, Rig>& camera_from_rig, LightImage& image);
  /// Draws only the surroundings of one tag, on an endless sheet of paper; black elsewhere.
  void render_tag(std::span<const Moment> moments, const RayGrid& rays,
                  const Transform<LeftCamera, Rig>& camera_from_rig, std::size_t tag,
                  LightImage& image);
  /// Fraction of a tag that a camera sees: inside the image, from its face, not hidden by the
  /// finger.
  [[nodiscard]] double visible_fraction(const Moment& moment, const Lens& lens,
                                        const Transform<LeftCamera, Rig>& camera_from_rig,
                                        std::size_t tag) const;

 private:
  struct Box {
    int left = 0, top = 0, right = 0, bottom = 0;  ///< pixels, right and bottom excluded
  };
  [[nodiscard]] Box box_of(std::span<const Moment> moments, const Lens& lens,
                           const Transform<LeftCamera, Rig>& camera_from_rig,
                           std::size_t tag) const;
  void draw_box(std::span<const Moment> moments, const RayGrid& rays,
                const Transform<LeftCamera, Rig>& camera_from_rig, std::span<const DrawnTag> tags,
                const Box& box, LightImage& image);
  void vignette(const Lens& lens, LightImage& image) const;

  std::vector<DrawnTag> tags_;
  Optics optics_;
  Lighting lighting_;
  Clutter clutter_;
  int reach_ = 0;  ///< by which the kernel extends beyond the pixel, in eighths of a pixel
  std::vector<float> kernel_;  ///< (8 + 2 reach)² eighths; sums to 1
  std::vector<float> fine_;
};

}  // namespace orthonav::bench
