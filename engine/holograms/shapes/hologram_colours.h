#pragma once

#include <array>
#include <string_view>

#include "base/result.h"
#include "render/scene.h"

namespace orthonav::engine {

/// The colours of holograms that say something: linear, tuned for an additive display. A colour
/// never says it alone: words, shapes and dashes say it too (docs/holograms.md).
struct HologramColours {
  render::Colour recording{1.0f, 0.78f, 0.04f, 1};      ///< stroke being digitized
  render::Colour saved{1.0f, 0.30f, 0.02f, 1};          ///< stroke that was saved
  render::Colour bone{0.92f, 0.86f, 0.74f, 0.35f};      ///< registered surface
  render::Colour unstroked{0.10f, 0.42f, 1.0f, 0.35f};  ///< surface without strokes
  render::Colour entry{0.12f, 0.36f, 1.0f, 1};          ///< entry points and screw heads
  render::Colour good{0.04f, 0.90f, 0.13f, 1};          ///< planned trajectory; within its limit
  render::Colour fair{1.0f, 0.42f, 0.0f, 1};            ///< between the limits
  render::Colour poor{1.0f, 0.06f, 0.04f, 1};           ///< beyond the limit; warnings
  render::Colour placed{0.02f, 0.72f, 0.80f, 1};        ///< measured wire; place to touch
  render::Colour rod{0.46f, 0.48f, 0.52f, 1};

  friend bool operator==(const HologramColours&, const HologramColours&) = default;

  /// An Error unless each is bright enough for a see-through display, and those that are shown
  /// beside each other and mean different things can be told apart.
  [[nodiscard]] Status check() const;
};

/// One of them by its name.
struct NamedColour {
  std::string_view name;
  render::Colour HologramColours::*colour;
};
inline constexpr std::array<NamedColour, 10> kNamedColours = {{
    {"recording", &HologramColours::recording},
    {"saved", &HologramColours::saved},
    {"bone", &HologramColours::bone},
    {"unstroked", &HologramColours::unstroked},
    {"entry", &HologramColours::entry},
    {"good", &HologramColours::good},
    {"fair", &HologramColours::fair},
    {"poor", &HologramColours::poor},
    {"placed", &HologramColours::placed},
    {"rod", &HologramColours::rod},
}};

/// Two colours that are shown beside each other and mean different things.
struct ColoursApart {
  render::Colour HologramColours::*first;
  render::Colour HologramColours::*second;
};
[[nodiscard]] const std::array<ColoursApart, 9>& colours_apart();

/// Distance of two opaque colours in CIELAB (CIE 1976 ΔE*ab, white point D65): about 2.3 is just
/// noticeable.
[[nodiscard]] double colour_difference(const render::Colour& a, const render::Colour& b);

/// `colour-blind`: told apart with red, green or blue cones missing.
[[nodiscard]] const HologramColours& colour_blind_colours();

/// From text: `standard`, `colour-blind`, or either with changes (`good=#40C4FF`, sRGB), separated
/// by commas; changes alone are of `standard`. Opacities stay. An Error names what is wrong.
[[nodiscard]] Result<HologramColours> read_colours(std::string_view text);

/// Those in use from now on. Like the wearer's language they are set once for the process, before
/// any thread is started that draws (decision 0110).
void use_colours(const HologramColours& colours);

namespace look {

/// Those in use.
[[nodiscard]] const HologramColours& colours();

// Text is white, since light can't darken its background and red light alone is unreadable on
// anything bright (docs/holograms.md has the contrasts); colour appears in a rim or in the mark
// beside it.
inline constexpr render::Colour kWhite{1, 1, 1, 1};
inline constexpr render::Colour kSoftWhite{0.90f, 0.90f, 0.90f, 1};
inline constexpr render::Colour kPale{0.86f, 0.86f, 0.86f, 1};
inline constexpr render::Colour kRing{0.30f, 0.30f, 0.30f, 1};

}  // namespace look
}  // namespace orthonav::engine
