#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "base/result.h"
#include "nav/guidance/rod.h"
#include "nav/guidance/rod_bends.h"

namespace orthonav::tools {

/// The arguments for a rod's heads.
struct RodHeadArguments {
  std::string heads;
  std::string units = "mm";
  double diameter_mm = 5.5;

  void add_to(CLI::App& command);
  /// An error message names the file.
  [[nodiscard]] Result<nav::RodTemplate> rod() const;
};

/// The bender and rod, and where the rod lies below the heads.
struct RodBendingArguments {
  std::string to_bone;  ///< empty: the heads' points are the seats
  double seat_mm = 6.0;
  double overhang_mm = 5.0;
  double bender_width_mm = 20.0;
  double die_radius_mm = 20.0;
  double tulip_mm = 10.0;
  double tolerance_mm = 0.3;
  std::string material = "Ti-6Al-4V";
  double yield_mpa = 758.0;
  double modulus_gpa = 114.0;
  double elongation_percent = 10.0;
  std::string spring_back;

  void add_to(CLI::App& command);
  /// Reads the file with the trials, where there is one.
  [[nodiscard]] Result<nav::RodBending> bending(double diameter_mm) const;
  [[nodiscard]] Result<std::vector<Vec3>> seats_m(const nav::RodTemplate& rod) const;
};

}  // namespace orthonav::tools
