#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/side.h"

namespace orthonav::nav {

// What a registration finds out about itself, as data. The words for people are made elsewhere
// (engine/session/text/wording.h).

/// A part of the vertebra's reachable surface, as surgeons name it.
struct BonePlace {
  enum class Part : std::uint8_t { kSpinousProcess, kLamina, kFacet };
  enum class Height : std::uint8_t { kUpper, kMiddle, kLower };

  Part part = Part::kSpinousProcess;
  std::optional<Side> side;  ///< absent for the spinous process
  Height height = Height::kMiddle;

  friend bool operator==(const BonePlace&, const BonePlace&) = default;
};

/// The motion of the bone that its strokes determine least.
struct UncertainMotion {
  enum class Kind : std::uint8_t {
    kLateral,
    kAnteroposterior,
    kCraniocaudal,
    kFlexion,  ///< and extension
    kLateralBending,
    kAxialRotation,
  };

  Kind kind = Kind::kLateral;
  double error_m = 0.0;  ///< root mean square, at the worst target

  friend bool operator==(const UncertainMotion&, const UncertainMotion&) = default;
};

/// Used instead of a label if several levels explain the points equally well.
inline constexpr std::string_view kSeveralLevels = "several levels";

/// One reason why a registration must not be used for guidance: what was found, and the limit.
struct RefusalReason {
  enum class Kind : std::uint8_t {
    kNoise,               ///< m, SD of the points about the surface
    kInliers,             ///< fraction of the points
    kShaftCollision,      ///< fraction of the points
    kLogLikelihoodRatio,  ///< against the runner-up
    kTre99AtScrews,       ///< m, below which 99 of 100 errors lie at the worst of the screws
    kFitsOtherLevel,      ///< no number; the label says which level
    kSoftTissue,          ///< m, SD of the tip's height over the bone; `scrape` says where
    kModelSize,           ///< size of the bone relative to the model
    kMirrored,            ///< log-likelihood ratio of the model's mirror image
    kTre99AtEnds,         ///< m, as kTre99AtScrews, at the ends of another bone than a vertebra
  };

  Kind kind = Kind::kNoise;
  double value = 0.0;
  double limit = 0.0;
  std::optional<UncertainMotion> motion;  ///< behind an error at the screws, where it is known
  std::string level;                      ///< of kFitsOtherLevel
  std::optional<BonePlace> scrape;        ///< of kSoftTissue, where it is known
};

}  // namespace orthonav::nav
