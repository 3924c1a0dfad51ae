#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/angle.h"
#include "base/how_many.h"
#include "engine/io/json_writer.h"
#include "nav/guidance/rod.h"
#include "nav/guidance/rod_bends.h"
#include "tools/orthonav/command.h"
#include "tools/orthonav/shared/json_output.h"
#include "tools/orthonav/shared/print_text.h"
#include "tools/orthonav/shared/rod_arguments.h"

namespace orthonav::tools {
namespace {

struct RodArguments {
  RodHeadArguments heads;
  RodBendingArguments bending;
  bool instructions = false;
  JsonOutput json;
};

nlohmann::ordered_json as_json(const nav::RodTemplate& rod) {
  nlohmann::ordered_json out = {{"length_mm", rod.length_m * 1e3},
                                {"diameter_mm", rod.diameter_m * 1e3},
                                {"heads_mm", nlohmann::ordered_json::array()},
                                {"bends", nlohmann::ordered_json::array()},
                                {"path_mm", nlohmann::ordered_json::array()}};
  for (const Vec3& head : rod.heads_m) {
    out["heads_mm"].push_back(engine::vector_mm(head));
  }
  for (const nav::RodBend& bend : rod.bends) {
    out["bends"].push_back({{"arc_length_mm", bend.arc_length_m * 1e3},
                            {"angle_deg", bend.angle_rad * kDegreesPerRadian},
                            {"position_mm", engine::vector_mm(bend.position_m)}});
  }
  for (const Vec3& p : rod.path_m) {
    out["path_mm"].push_back(engine::vector_mm(p));
  }
  return out;
}

void print(const nav::RodTemplate& rod) {
  print_text("rod through %zu heads: length %.3f mm, diameter %.1f mm, %s\n", rod.heads_m.size(),
             rod.length_m * 1e3, rod.diameter_m * 1e3, how_many(rod.bends.size(), "bend").c_str());
  for (const nav::RodBend& bend : rod.bends) {
    print_text("bend at %.1f mm: %.1f°\n", bend.arc_length_m * 1e3,
               bend.angle_rad * kDegreesPerRadian);
  }
}

nlohmann::ordered_json as_json(const nav::RodInstructions& told) {
  nlohmann::ordered_json out = {{"cut_length_mm", told.cut_length_m() * 1e3},
                                {"worst_seat_mm", told.fit.worst_off_m * 1e3},
                                {"reach_into_tulip_mm", told.reach_m * 1e3},
                                {"seats_mm", nlohmann::ordered_json::array()},
                                {"bends", nlohmann::ordered_json::array()}};
  for (const nav::SeatOnRod& seat : told.fit.seats) {
    out["seats_mm"].push_back(seat.at_m * 1e3);
  }
  for (const nav::RodInstruction& bend : told.bends) {
    out["bends"].push_back({{"arc_length_mm", bend.arc.centre_m * 1e3},
                            {"roll_deg", bend.arc.roll_rad * kDegreesPerRadian},
                            {"angle_deg", bend.arc.angle_rad * kDegreesPerRadian},
                            {"set_deg", bend.set_rad * kDegreesPerRadian}});
  }
  return out;
}

void print(const nav::RodInstructions& told) {
  const double first_m = told.fit.seats.front().at_m;
  const double last_m = told.cut_length_m() - told.fit.seats.back().at_m;
  print_text("cut to %.1f mm; draw a line along it\n", told.cut_length_m() * 1e3);
  print_text(
      "mark the middles of the end heads: %.1f mm from the first end, %.1f mm from the last\n",
      first_m * 1e3, last_m * 1e3);
  for (std::size_t k = 0; k < told.bends.size(); ++k) {
    const nav::RodInstruction& bend = told.bends[k];
    print_text("bend %zu: middle at %.1f mm, roll %.0f°, angle %.1f°, set %.1f°\n", k + 1,
               bend.arc.centre_m * 1e3, bend.arc.roll_rad * kDegreesPerRadian,
               bend.arc.angle_rad * kDegreesPerRadian, bend.set_rad * kDegreesPerRadian);
  }
  print_text("farthest head %.2f mm off\n", told.fit.worst_off_m * 1e3);
  if (told.reach_m >= 0.0005) {
    print_text("bends reach up to %.1f mm into the tulips\n", told.reach_m * 1e3);
  }
}

/// Writes template and instructions; returns 1 if no instructions reach the heads.
int run_instructions(const RodArguments& arguments, const nav::RodTemplate& rod) {
  const auto bending = arguments.bending.bending(arguments.heads.diameter_mm);
  if (!bending) {
    return bad_input(bending.error().message);
  }
  const auto seats_m = arguments.bending.seats_m(rod);
  if (!seats_m) {
    return bad_input(seats_m.error().message);
  }
  const auto told = nav::rod_instructions(*seats_m, *bending);
  nlohmann::ordered_json out = as_json(rod);
  if (told) {
    out["instructions"] = as_json(*told);
  } else {
    out["no_instructions"] = told.error().message;
  }
  if (const Status s = arguments.json.write(out); !s) {
    return bad_input(s.error().message);
  }
  if (!arguments.json.on_stdout()) {
    print(rod);
    if (told) {
      print(*told);
    }
  }
  if (!told) {
    std::fprintf(stderr, "orthonav: %s: %s\n", arguments.heads.heads.c_str(),
                 told.error().message.c_str());
  }
  return told ? kDone : kNo;
}

int run_rod(const RodArguments& arguments) {
  if (const Status s = arguments.json.check(); !s) {
    return bad_input(s.error().message);
  }
  const auto rod = arguments.heads.rod();
  if (!rod) {
    return bad_input(rod.error().message);
  }
  if (arguments.instructions) {
    return run_instructions(arguments, *rod);
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
  CLI::App* command = app.add_subcommand(
      "rod", "Rod template through screw heads: spline, length, bends; bending instructions");
  arguments->heads.add_to(*command);
  command->add_flag("--instructions", arguments->instructions,
                    "Also how to bend it: cut length, and place, roll and angle of each bend");
  arguments->bending.add_to(*command);
  arguments->json.add_to(*command);
  command->footer(
      "\nThe rod is a centripetal Catmull-Rom spline through the heads, ordered along their\n"
      "principal axis; its length is exact to 1 um. A bend's angle is that between the chords\n"
      "before and after a head, its place the length along the rod from the first head. Refused "
      "is\n"
      "what no rod of a spine is: heads less than 5 mm or, along the rod, more than 150 mm apart,\n"
      "bends of more than 60 degrees, points that double back, more than 600 mm of length.\n"
      "Instructions place bends between the heads alone, in order from the first end, none bent\n"
      "back; roll is against a line drawn along the rod, clockwise as seen from the first end; "
      "set\n"
      "is the angle on the bender, with spring-back. Exit code 1 with the reason where a radius\n"
      "would be too tight or no rod of this bender passes the heads. On paper: print rod.");
  command->callback([arguments, &action] { action = [arguments] { return run_rod(*arguments); }; });
}

}  // namespace orthonav::tools
