#include "tools/orthonav/shared/rod_arguments.h"

#include <algorithm>
#include <vector>

#include "engine/case/likely_mistakes.h"
#include "engine/case/points_file.h"
#include "engine/case/spring_back_file.h"
#include "engine/io/text_fields.h"
#include "nav/guidance/rod_cut.h"
#include "tools/orthonav/shared/arguments.h"

namespace orthonav::tools {
namespace {

Result<std::vector<Vec3>> load_heads_m(const RodHeadArguments& arguments) {
  const auto file = engine::load_points(arguments.heads);
  if (!file) {
    return file.error();
  }
  const auto other = std::find_if(file->regions.begin(), file->regions.end(),
                                  [&](const std::string& r) { return r != file->regions[0]; });
  if (other != file->regions.end()) {
    return Error{arguments.heads + ": holds heads of regions \"" + file->regions[0] + "\" and \"" +
                 *other + "\", must be one rod"};
  }
  const double unit_m = file->metres_per_unit.value_or(arguments.units == "m" ? 1.0 : 1e-3);
  std::vector<Vec3> heads_m;
  for (const Vec3& p : file->points) {
    heads_m.push_back(unit_m * p);
  }
  return heads_m;
}

Result<Vec3> direction_from(const std::string& text) {
  const auto fields = engine::split(text, ',');
  Vec3 direction;
  for (int i = 0; i < 3 && fields.size() == 3; ++i) {
    const auto number = engine::number_from(fields[static_cast<std::size_t>(i)]);
    if (!number) {
      return Error{"--to-bone: \"" + text + "\" must be three numbers X,Y,Z"};
    }
    direction[i] = *number;
  }
  if (fields.size() != 3 || direction.norm() == 0.0) {
    return Error{"--to-bone: \"" + text + "\" must be three numbers X,Y,Z, not all of them 0"};
  }
  return direction;
}

void add_length(CLI::App& command, const char* name, double& value_mm, const char* what,
                double least_mm, double most_mm) {
  command.add_option(name, value_mm, what)
      ->check(finite_number(least_mm, most_mm))
      ->capture_default_str();
}

}  // namespace

void RodHeadArguments::add_to(CLI::App& command) {
  command
      .add_option("--heads", heads,
                  "Screw heads of one rod in any order (CSV x,y,z; PLY; 3D Slicer markups)")
      ->required()
      ->type_name("FILE");
  command.add_option("--units", units, "Unit of a file that declares none")
      ->check(CLI::IsMember({"mm", "m"}))
      ->capture_default_str();
  command.add_option("--diameter-mm", diameter_mm, "Rod diameter")
      ->check(finite_number(1, 15))
      ->capture_default_str();
}

Result<nav::RodTemplate> RodHeadArguments::rod() const {
  const auto heads_m = load_heads_m(*this);
  if (!heads_m) {
    return heads_m.error();
  }
  auto rod = nav::rod_template(*heads_m, diameter_mm * 1e-3);
  if (!rod) {
    const Status scale = engine::check_scale(*heads_m, true);
    return Error{heads + ": " + rod.error().message +
                 (scale ? "" : ": is their unit another one (--units)?")};
  }
  return rod;
}

void RodBendingArguments::add_to(CLI::App& command) {
  command
      .add_option("--to-bone", to_bone,
                  "X,Y,Z from heads to bone: the rod lies --seat-mm below where they were touched; "
                  "without, the "
                  "points given are where it lies")
      ->check(some_text());
  add_length(command, "--seat-mm", seat_mm,
             "From where a head was touched to the rod's middle, negative away from the bone", -15,
             30);
  add_length(command, "--overhang-mm", overhang_mm, "Wanted beyond the first and last head", 0, 50);
  add_length(command, "--bender-width-mm", bender_width_mm, "Of the rod that a bend curves", 2,
             100);
  add_length(command, "--die-radius-mm", die_radius_mm, "Of the rod's axis over the die", 1, 500);
  add_length(command, "--tulip-mm", tulip_mm, "Of the rod that a head holds straight", 0, 30);
  add_length(command, "--tolerance-mm", tolerance_mm, "From every head's seat to the rod", 0.05, 5);
  command.add_option("--material", material, "Name of the rod's material")
      ->check(some_text())
      ->capture_default_str();
  add_length(command, "--yield-mpa", yield_mpa, "Its yield strength", 10, 3000);
  add_length(command, "--modulus-gpa", modulus_gpa, "Its elastic modulus", 1, 400);
  add_length(command, "--elongation-percent", elongation_percent,
             "At break: no fibre is strained further", 1, 60);
  command
      .add_option("--spring-back", spring_back,
                  "Trials on that bender with that rod (CSV set_deg,kept_deg), in place of yield "
                  "and modulus")
      ->check(some_text())
      ->type_name("FILE");
}

Result<nav::RodBending> RodBendingArguments::bending(double diameter_mm) const {
  nav::RodBending bending;
  bending.bender = {bender_width_mm * 1e-3, die_radius_mm * 1e-3};
  bending.material.name = material;
  bending.material.yield_pa = yield_mpa * 1e6;
  bending.material.modulus_pa = modulus_gpa * 1e9;
  bending.material.elongation = elongation_percent * 1e-2;
  bending.diameter_m = diameter_mm * 1e-3;
  bending.overhang_m = overhang_mm * 1e-3;
  bending.tulip_m = tulip_mm * 1e-3;
  bending.tolerance_m = tolerance_mm * 1e-3;
  if (!spring_back.empty()) {
    auto trials = engine::load_spring_back(spring_back);
    if (!trials) {
      return trials.error();
    }
    bending.material.trials = *std::move(trials);
  }
  const auto checked = nav::RodSpringBack::of(bending.bender, bending.material, bending.diameter_m);
  if (!checked) {
    return Error{(spring_back.empty() ? "" : spring_back + ": ") + checked.error().message};
  }
  return bending;
}

Result<std::vector<Vec3>> RodBendingArguments::seats_m(const nav::RodTemplate& rod) const {
  if (to_bone.empty()) {
    return rod.heads_m;
  }
  const auto direction = direction_from(to_bone);
  if (!direction) {
    return direction.error();
  }
  const std::vector<Vec3> all(rod.heads_m.size(), *direction);
  const auto cut = nav::rod_cut(rod, all, {seat_mm * 1e-3, overhang_mm * 1e-3});
  if (!cut) {
    return cut.error();
  }
  return cut->seats_m;
}

}  // namespace orthonav::tools
