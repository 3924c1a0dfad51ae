#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/angle.h"
#include "engine/case/points_file.h"
#include "nav/guidance/rod.h"
#include "tools/arguments.h"
#include "tools/command.h"
#include "tools/json_output.h"
#include "tools/print_text.h"

namespace orthonav::tools {
namespace {

struct RodArguments {
  std::string heads;
  std::string units = "mm";
  double diameter_mm = 5.5;
  JsonOutput json;
};

Result<std::vector<Vec3>> load_heads_m(const RodArguments& arguments) {
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

nlohmann::ordered_json in_mm(Vec3 v_m) { return {v_m.x * 1e3, v_m.y * 1e3, v_m.z * 1e3}; }

nlohmann::ordered_json as_json(const nav::RodTemplate& rod) {
  nlohmann::ordered_json out = {{"length_mm", rod.length_m * 1e3},
                                {"diameter_mm", rod.diameter_m * 1e3},
                                {"heads_mm", nlohmann::ordered_json::array()},
                                {"bends", nlohmann::ordered_json::array()},
                                {"path_mm", nlohmann::ordered_json::array()}};
  for (const Vec3& head : rod.heads_m) {
    out["heads_mm"].push_back(in_mm(head));
  }
  for (const nav::RodBend& bend : rod.bends) {
    out["bends"].push_back({{"arc_length_mm", bend.arc_length_m * 1e3},
                            {"angle_deg", bend.angle_rad * kDegreesPerRadian},
                            {"position_mm", in_mm(bend.position_m)}});
  }
  for (const Vec3& p : rod.path_m) {
    out["path_mm"].push_back(in_mm(p));
  }
  return out;
}

void print(const nav::RodTemplate& rod) {
  print_text("rod through %zu heads: length %.3f mm, diameter %.1f mm, %zu bends\n",
             rod.heads_m.size(), rod.length_m * 1e3, rod.diameter_m * 1e3, rod.bends.size());
  for (const nav::RodBend& bend : rod.bends) {
    print_text("bend at %.1f mm: %.1f°\n", bend.arc_length_m * 1e3,
               bend.angle_rad * kDegreesPerRadian);
  }
}

int run_rod(const RodArguments& arguments) {
  if (const Status s = arguments.json.check(); !s) {
    return bad_input(s.error().message);
  }
  const auto heads_m = load_heads_m(arguments);
  if (!heads_m) {
    return bad_input(heads_m.error().message);
  }
  const auto rod = nav::rod_template(*heads_m, arguments.diameter_mm * 1e-3);
  if (!rod) {
    return bad_input(arguments.heads + ": " + rod.error().message);
  }
  if (const Status s = arguments.json.write(as_json(*rod)); !s) {
    return bad_input(s.error().message);
  }
  if (!arguments.json.on_stdout()) {
    print(*rod);
  }
  return kDone;
}

}  // namespace

void add_rod_command(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<RodArguments>();
  CLI::App* command =
      app.add_subcommand("rod", "Rod template through screw heads: spline, length, bends");
  command
      ->add_option("--heads", arguments->heads,
                   "Screw heads of one rod in any order (CSV x,y,z; PLY; 3D Slicer markups)")
      ->required()
      ->type_name("FILE");
  command->add_option("--units", arguments->units, "Unit of a file that declares none")
      ->check(CLI::IsMember({"mm", "m"}))
      ->capture_default_str();
  command->add_option("--diameter-mm", arguments->diameter_mm, "Rod diameter")
      ->check(finite_number(1, 15))
      ->capture_default_str();
  arguments->json.add_to(*command);
  command->footer(
      "\nThe rod is a centripetal Catmull-Rom spline through the heads, ordered along their\n"
      "principal axis; its length is exact to 1 um. A bend's angle is that between the chords\n"
      "before and after a head, its place the length along the rod from the first head. Refused "
      "is\n"
      "what no rod of a spine is: heads less than 5 mm or, along the rod, more than 150 mm apart,\n"
      "bends of more than 60 degrees, points that double back, more than 600 mm of length.");
  command->callback([arguments, &action] { action = [arguments] { return run_rod(*arguments); }; });
}

}  // namespace orthonav::tools
