#include "engine/holograms/shapes/hologram_colours.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

#include "base/printed.h"
#include "base/srgb.h"
#include "engine/io/text_fields.h"

namespace orthonav::engine {
namespace {

using render::Colour;

/// Luminance of the display's white that a colour has at least: about 2.5:1 against bone in a
/// room of 1000 lux, as seen through the combiner (OpticalModel).
constexpr double kDarkest = 0.2;
/// Of two colours that mean different things: nearly ten times what is just noticeable, since they
/// are seen as thin lines.
constexpr double kApart = 20.0;

HologramColours& in_use() {
  static HologramColours colours;
  return colours;
}

/// Relative to white.
double luminance(const Colour& c) {
  return kLuminance[0] * c.r + kLuminance[1] * c.g + kLuminance[2] * c.b;
}

std::array<double, 3> lab(const Colour& c) {
  const auto f = [](double t) {
    constexpr double kBend = 6.0 / 29;
    return t > kBend * kBend * kBend ? std::cbrt(t) : t / (3 * kBend * kBend) + 4.0 / 29;
  };
  const double x = f((0.4124564 * c.r + 0.3575761 * c.g + 0.1804375 * c.b) / 0.95047);
  const double y = f(luminance(c));
  const double z = f((0.0193339 * c.r + 0.1191920 * c.g + 0.9503041 * c.b) / 1.08883);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

/// RRGGBB as linear light, with the opacity of `before`. False if it is none.
bool read_hex(std::string_view digits, Colour& before) {
  unsigned value = 0;
  const char* end = digits.data() + digits.size();
  const auto read = std::from_chars(digits.data(), end, value, 16);
  if (digits.size() != 6 || read.ec != std::errc() || read.ptr != end) {
    return false;
  }
  const auto channel = [&](unsigned shift) {
    return static_cast<float>(linear_from_srgb(((value >> shift) & 0xFFu) / 255.0));
  };
  before = {channel(16), channel(8), channel(0), before.a};
  return true;
}

std::string_view name_of(Colour HologramColours::*colour) {
  return std::find_if(kNamedColours.begin(), kNamedColours.end(),
                      [&](const NamedColour& each) { return each.colour == colour; })
      ->name;
}

std::string known_names() {
  std::string names;
  for (const NamedColour& known : kNamedColours) {
    names.append(names.empty() ? "" : ", ").append(known.name);
  }
  return names;
}

Status change(HologramColours& colours, std::string_view item) {
  const std::size_t equals = item.find('=');
  const std::string_view name = item.substr(0, equals);
  const auto known = std::find_if(kNamedColours.begin(), kNamedColours.end(),
                                  [&](const NamedColour& each) { return each.name == name; });
  if (known == kNamedColours.end()) {
    return Error{"'" + std::string(name) + "' is none of the colours " + known_names() +
                 ", and neither standard nor colour-blind at the beginning"};
  }
  const std::string_view value =
      equals == std::string_view::npos ? std::string_view() : item.substr(equals + 1);
  if (value.empty() || value.front() != '#' ||
      !read_hex(value.substr(1), colours.*(known->colour))) {
    return Error{std::string(name) + " must be a colour like #40C4FF"};
  }
  return {};
}

}  // namespace

const std::array<ColoursApart, 9>& colours_apart() {
  using C = HologramColours;
  static constexpr std::array<ColoursApart, 9> kPairs = {{
      {&C::good, &C::fair},
      {&C::good, &C::poor},
      {&C::fair, &C::poor},
      {&C::recording, &C::saved},
      {&C::bone, &C::unstroked},
      {&C::good, &C::placed},
      {&C::placed, &C::poor},
      {&C::good, &C::entry},
      {&C::entry, &C::rod},
  }};
  return kPairs;
}

double colour_difference(const Colour& a, const Colour& b) {
  const auto first = lab(a);
  const auto second = lab(b);
  return std::hypot(first[0] - second[0], first[1] - second[1], first[2] - second[2]);
}

Status HologramColours::check() const {
  for (const NamedColour& each : kNamedColours) {
    const double light = luminance(this->*each.colour);
    if (!(light >= kDarkest)) {
      return Error{printed("%s has %.2f of white's luminance; a see-through display needs %.2f",
                           each.name.data(), light, kDarkest)};
    }
  }
  for (const ColoursApart& pair : colours_apart()) {
    const double apart = colour_difference(this->*pair.first, this->*pair.second);
    if (!(apart >= kApart)) {
      return Error{
          printed("%s and %s are too much alike: %.0f apart in CIELAB, at least %.0f needed",
                  name_of(pair.first).data(), name_of(pair.second).data(), apart, kApart)};
    }
  }
  return {};
}

const HologramColours& colour_blind_colours() {
  static const HologramColours kColours = [] {
    HologramColours colours;
    read_hex("FFF36B", colours.recording);
    read_hex("D9822B", colours.saved);
    read_hex("5C6CFF", colours.entry);
    read_hex("40C4FF", colours.good);
    read_hex("FFF36B", colours.fair);
    read_hex("FF3B1F", colours.poor);
    read_hex("FFD6E8", colours.placed);
    return colours;
  }();
  return kColours;
}

Result<HologramColours> read_colours(std::string_view text) {
  HologramColours colours;
  bool first = true;
  for (const std::string& item : split(text, ',')) {
    if (first && item == "colour-blind") {
      colours = colour_blind_colours();
    } else if (!first || item != "standard") {
      if (Status changed = change(colours, item); !changed) {
        return changed.error();
      }
    }
    first = false;
  }
  if (Status good = colours.check(); !good) {
    return good.error();
  }
  return colours;
}

void use_colours(const HologramColours& colours) { in_use() = colours; }

const HologramColours& look::colours() { return in_use(); }

}  // namespace orthonav::engine
