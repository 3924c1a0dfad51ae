#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "engine/session/method.h"
#include "engine/session/text/wording.h"
#include "tools/orthonav/command.h"
#include "tools/orthonav/register/register_inputs.h"
#include "tools/orthonav/register/register_outputs.h"
#include "tools/orthonav/shared/arguments.h"
#include "tools/orthonav/shared/print_text.h"

namespace orthonav::tools {
namespace {

constexpr double kLargestTip_mm = 10.0;
constexpr double kLargestModelSd_mm = 2.0;

void print_screws(const engine::RegisteredLevel& level) {
  const auto place = [](const engine::PlaceError& e) {
    return printed("%.2f mm (95 %% below %.2f)", e.rms_m * 1e3, e.within_95_m * 1e3);
  };
  for (const engine::ScrewErrors& s : engine::errors_at_screws(level)) {
    print_text("error to expect at the %s screw: entry %s, target %s\n", name_of(s.side),
               place(s.entry).c_str(), place(s.target).c_str());
  }
}

void print(const engine::RegisteredLevel& level, const engine::FigureFrame& frame) {
  const nav::Registration& r = level.registration;
  const bool judged = engine::is_judged(r);
  const char* verdict = !r.accepted ? "refused" : judged ? "accepted" : "not judged, look at it";
  print_text("%s: %zu points, RMSE %.2f mm", verdict, r.points, r.rmse_m * 1e3);
  if (engine::runner_up_distance(level)) {
    print_text(", next best pose %.2f mm", r.runner_up_rmse_m * 1e3);
  }
  print_text("\n");
  if (judged) {
    print_text(
        "%.0f %% of the points on the bone, scatter %.2f mm, estimated offset of the tip above it "
        "%.2f mm (corrected); %.0f effective points; %.0f %% of the surface stroked\n",
        r.inlier_fraction * 1e2, r.noise_m * 1e3, r.standoff_m * 1e3, r.effective_points,
        r.coverage_fraction * 1e2);
  }
  print_text("%s\n", engine::ambiguity_of(level).c_str());
  print_screws(level);
  print_text("%s\n", engine::certainty_of(level).c_str());
  print_text("model to points (%s):\n", frame.points_unit_m == 1.0 ? "m" : "mm");
  const auto a = engine::model_to_points(r.world_from_vertebra, frame);
  for (std::size_t i = 0; i < 16; i += 4) {
    print_text("%12.6f %12.6f %12.6f %14.6f\n", a[i], a[i + 1], a[i + 2], a[i + 3]);
  }
}

/// Prints why it was refused, what to do about it, and which file is not of this registration.
void print_refusal(const nav::Registration& r, const std::string& transform) {
  for (const nav::RefusalReason& reason : r.reasons) {
    std::fprintf(stderr, "orthonav: refused: %s\n", engine::text_of(reason).c_str());
  }
  if (!r.accepted && !transform.empty()) {
    std::fprintf(stderr, "orthonav: %s: not written, since the registration is refused\n",
                 transform.c_str());
  }
  if (!r.accepted && r.stroke_next) {
    std::fprintf(stderr, "orthonav: to improve: %s\n", engine::text_of(*r.stroke_next).c_str());
  }
}

/// Strokes on a sawbone pelvis lie in a field of 0.3 mm over the model of its CT
/// (docs/real-measurements.md); of vertebrae there is no such measurement.
double model_sd_mm(const RegisterArguments& arguments) {
  constexpr double kOfAnyBone_mm = 0.3;
  return arguments.model_sd_mm.value_or(arguments.any_bone ? kOfAnyBone_mm : 0.0);
}

int run_register(const RegisterArguments& arguments, const RegisterOutputs& outputs) {
  const auto registrar = engine::registrar_named(arguments.method);
  if (!registrar) {
    return bad_input(registrar.error().message);
  }
  if (arguments.any_bone && !outputs.report.empty()) {
    return bad_input("register: --any-bone excludes --report, whose page is of a vertebra");
  }
  if (const Status s = outputs.check(); !s) {
    return bad_input(s.error().message);
  }
  const auto inputs = load_register_inputs(arguments, [&](const RegisterInputs& points) {
    return outputs.check_inputs(points, arguments.points);
  });
  if (!inputs) {
    return bad_input(inputs.error().message);
  }
  const double tip_radius_m = arguments.tip_radius_mm * 1e-3;
  const auto registration = (*registrar)({*inputs->level.model,
                                          inputs->points,
                                          inputs->level.screws,
                                          inputs->level.neighbours,
                                          arguments.common.in_metres(),
                                          {},
                                          {},
                                          tip_radius_m,
                                          model_sd_mm(arguments) * 1e-3});
  if (!registration) {
    return bad_input(arguments.points + ": " + registration.error().message);
  }
  const engine::RegisteredLevel level{inputs->level.label,  arguments.method, inputs->level.model,
                                      inputs->level.screws, inputs->points,   *registration,
                                      tip_radius_m};
  if (const Status s = outputs.write(level, *inputs, arguments.points); !s) {
    return bad_input(s.error().message);
  }
  if (!outputs.json.on_stdout()) {
    print(level, inputs->frame);
  }
  print_refusal(*registration, outputs.transform);
  return registration->accepted ? kDone : kNo;
}

constexpr const char* kRegisterFooter =
    "\nExit code 0: accepted; 1: refused, with the reasons and what to stroke next on standard\n"
    "error; 2: bad input.\n"
    "The model's axes are the patient's (LPS: +x left, +y posterior, +z superior), its origin is\n"
    "free. The points may be in any frame, in the order of time. model_to_points is a 4x4 matrix\n"
    "for column vectors, by rows: from the model (in its file's axes; a case's in LPS; in the\n"
    "points' unit) to the points.\n"
    "predicted_tre_mm: root mean square error to expect at the worst of the plan's entries and\n"
    "targets; without a plan, where screws usually go (paper predicts none: null).\n"
    "Without what all points share (--tip-sd-mm and the others), errors to expect are those of "
    "the\n"
    "registration alone. The limits are about these.\n"
    "With --any-bone 99 % of errors must be below 2 mm at both ends of the bone along each of its\n"
    "principal axes.\n"
    "With --level the strokes are tried on every other level of the case too, and refused where\n"
    "they fit one of them as well; with --model the level can't be checked.";

void add_inputs(CLI::App& command, RegisterArguments& arguments) {
  command.add_option("--model", arguments.model, "Vertebra (STL, PLY, OBJ)")->type_name("MESH");
  command
      .add_option("--points", arguments.points,
                  "Digitized points (CSV x,y,z[,region]; PLY; 3D Slicer markups)")
      ->required()
      ->type_name("FILE");
  command
      .add_option(
          "--units", arguments.units,
          "Unit of files that declare none; a model with a plan has the plan's (default: mm)")
      ->check(CLI::IsMember({"mm", "m"}));
  command
      .add_option("--frame", arguments.frame,
                  "Axes of a model whose file declares none (default: the plan's, else LPS)")
      ->check(CLI::IsMember({"LPS", "RAS"}));
  command
      .add_option("--plan", arguments.plans,
                  "Planned screws, for the error to expect there; several files are one plan")
      ->type_name("PLAN")
      ->allow_extra_args(false);
  command
      .add_option(
          "-c,--case", arguments.case_folder,
          "Instead of --model and --plan: folder with case.json (default: the built-in phantom)")
      ->check(some_text())
      ->transform(folder_of_case())
      ->type_name("DIR");
  command.add_flag("--any-bone", arguments.any_bone,
                   "The model is of another bone than a vertebra, up to 600 mm across: all of its "
                   "surface may be stroked; accepted by the error to expect at its ends alone");
  command.add_option("--level", arguments.level, "Level of the case that was stroked")
      ->check(some_text());
  command
      .add_option("--tip-radius-mm", arguments.tip_radius_mm,
                  "Radius of a ball at the pointer's end, whose centre the points are")
      ->check(finite_number(0, kLargestTip_mm))
      ->capture_default_str();
  command
      .add_option(
          "--model-sd-mm", arguments.model_sd_mm,
          "SD over the bone by which the model differs from it, at least, 0 to 2 (default: 0, what "
          "the points show; with --any-bone 0.3)")
      ->check(finite_number(0, kLargestModelSd_mm));
  arguments.common.add_to(command, {});
  add_method_option(command, arguments.method, "registration: best or paper");
}

}  // namespace

void add_register_command(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<RegisterArguments>();
  auto outputs = std::make_shared<RegisterOutputs>();
  CLI::App* command =
      app.add_subcommand("register", "Registers digitized points to a preoperative model");
  add_inputs(*command, *arguments);
  outputs->json.add_to(*command);
  command
      ->add_option("--report", outputs->report,
                   "The registration as a page: pictures from three sides, every figure")
      ->check(some_text())
      ->type_name("FILE.html");
  command
      ->add_option("--transform", outputs->transform,
                   "The pose, if accepted, for 3D Slicer (.tfm, .h5): drag the model onto it")
      ->check(some_text())
      ->type_name("FILE");
  command->footer(kRegisterFooter);
  command->callback([arguments, outputs, &action] {
    action = [arguments, outputs] { return run_register(*arguments, *outputs); };
  });
}

}  // namespace orthonav::tools
