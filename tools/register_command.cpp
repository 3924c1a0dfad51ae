#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "engine/mesh_file.h"
#include "engine/method.h"
#include "engine/model_cache.h"
#include "engine/operation.h"
#include "engine/plan_file.h"
#include "engine/points_file.h"
#include "nav/guidance/predicted_error.h"
#include "tools/command.h"
#include "tools/json_output.h"
#include "tools/model_notes.h"

namespace orthonav::tools {
namespace {

using engine::Axes;

struct RegisterArguments {
  std::string model;
  std::string points;
  std::string units;  ///< empty: what the files say, else mm
  std::string frame;  ///< empty: what the files say, else LPS
  std::string plan;
  std::string method = "best";
  std::string cache;  ///< folder; empty: nothing is kept
  JsonOutput json;
};

struct Inputs {
  std::shared_ptr<const nav::VertebraModel> model;
  Axes model_axes = Axes::kLps;  ///< of the file
  std::vector<Point<World>> points;
  double points_unit_m = 1e-3;
  std::optional<engine::Plan> plan;
};

/// The unit of a model is its plan's. Without a plan it is the unit given, or millimetres where
/// only they make a vertebra of it: digitized points in metres beside a model in millimetres are
/// common.
Result<nav::TriangleMesh> load_model(const RegisterArguments& arguments, const Inputs& inputs,
                                     Axes axes) {
  if (inputs.plan) return engine::load_mesh(arguments.model, inputs.plan->metres_per_unit, axes);
  if (arguments.units != "m") return engine::load_mesh(arguments.model, 1e-3, axes);
  auto in_metres = engine::load_mesh(arguments.model, 1.0, axes);
  if (in_metres) return in_metres;
  auto in_millimetres = engine::load_mesh(arguments.model, 1e-3, axes);
  return in_millimetres ? in_millimetres : in_metres;
}

Status load_points(const RegisterArguments& arguments, Inputs& inputs) {
  const auto file = engine::load_points(arguments.points);
  if (!file) return file.error();
  const double given_m = arguments.units == "m" ? 1.0 : 1e-3;
  inputs.points_unit_m = file->metres_per_unit.value_or(given_m);
  for (const Vec3& p : file->points) inputs.points.push_back({inputs.points_unit_m * p});
  return {};
}

Result<Inputs> load(const RegisterArguments& arguments) {
  Inputs inputs;
  if (!arguments.plan.empty()) {
    auto plan = engine::load_plan(arguments.plan);
    if (!plan) return plan.error();
    inputs.plan = std::move(*plan);
  }
  const Axes axes = !arguments.frame.empty() ? *engine::axes_from(arguments.frame)
                    : inputs.plan            ? inputs.plan->axes
                                             : Axes::kLps;
  auto mesh = load_model(arguments, inputs, axes);
  if (!mesh) return mesh.error();
  inputs.model_axes = engine::declared_axes(arguments.model).value_or(axes);
  if (const Status s = load_points(arguments, inputs); !s) return s.error();
  engine::ModelCache models(arguments.cache);
  auto model = models.prepared(*mesh);
  if (!model) return Error{arguments.model + ": " + model.error().message};
  inputs.model = std::move(*model);
  models.keep();
  print_notes(models);
  return inputs;
}

using Predictions = std::vector<nav::PredictedScrewError>;

Predictions at_screws(const Inputs& inputs, const nav::Registration& r) {
  return inputs.plan ? nav::predicted_errors(r, inputs.plan->screws) : Predictions{};
}

/// The worst at the screws, or at the model's centre where no plan says where they go.
double predicted_tre_m(const Predictions& screws, const nav::Registration& r) {
  return screws.empty() ? r.predicted_tre_m : nav::worst_m(screws);
}

/// From the model's file (its axes, the points' unit) to the points' file.
nlohmann::ordered_json model_to_points(const Inputs& inputs, const nav::Registration& r) {
  Mat3 rotation = r.world_from_vertebra.rotation();
  if (inputs.model_axes == Axes::kRas)
    rotation = Mat3::from_columns(-rotation.column(0), -rotation.column(1), rotation.column(2));
  const Transform<World, Vertebra> in_unit(
      rotation, r.world_from_vertebra.translation() / inputs.points_unit_m);
  const std::array<double, 16> a = in_unit.row_major();
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (std::size_t row = 0; row < 16; row += 4)
    rows.push_back({a[row], a[row + 1], a[row + 2], a[row + 3]});
  return rows;
}

/// JSON has no infinity: null stands for "not known to be bounded".
nlohmann::ordered_json in_mm(double m) {
  return std::isfinite(m) ? nlohmann::ordered_json(m * 1e3) : nlohmann::ordered_json();
}

nlohmann::ordered_json as_json(const RegisterArguments& arguments, const Inputs& inputs,
                               const nav::Registration& r) {
  const auto screws = at_screws(inputs, r);
  nlohmann::ordered_json out = {{"accepted", r.accepted},
                                {"reasons", r.reasons},
                                {"method", arguments.method},
                                {"points", r.points},
                                {"points_unit", inputs.points_unit_m == 1.0 ? "m" : "mm"},
                                {"model_frame", inputs.model_axes == Axes::kRas ? "RAS" : "LPS"},
                                {"model_to_points", model_to_points(inputs, r)},
                                {"rmse_mm", in_mm(r.rmse_m)},
                                {"runner_up_rmse_mm", in_mm(r.runner_up_rmse_m)},
                                {"predicted_tre_mm", in_mm(predicted_tre_m(screws, r))},
                                {"iterations", r.iterations}};
  for (const nav::PredictedScrewError& s : screws)
    out["screws"].push_back({{"side", engine::name_of(s.side)},
                             {"predicted_entry_tre_mm", in_mm(s.entry_m)},
                             {"predicted_target_tre_mm", in_mm(s.target_m)}});
  return out;
}

void print(const Inputs& inputs, const nav::Registration& r) {
  const auto screws = at_screws(inputs, r);
  std::printf("%s: %zu points, RMSE %.2f mm, next best pose %.2f mm\n",
              r.accepted ? "accepted" : "refused", r.points, r.rmse_m * 1e3,
              r.runner_up_rmse_m * 1e3);
  if (screws.empty())
    std::printf("error to expect at the model's centre: %.2f mm\n", r.predicted_tre_m * 1e3);
  for (const nav::PredictedScrewError& s : screws)
    std::printf("error to expect at the %s screw: entry %.2f mm, target %.2f mm\n",
                engine::name_of(s.side), s.entry_m * 1e3, s.target_m * 1e3);
  std::printf("model to points (%s):\n", inputs.points_unit_m == 1.0 ? "m" : "mm");
  for (const auto& row : model_to_points(inputs, r))
    std::printf("%12.6f %12.6f %12.6f %14.6f\n", row[0].get<double>(), row[1].get<double>(),
                row[2].get<double>(), row[3].get<double>());
}

int run_register(const RegisterArguments& arguments) {
  const auto registrar = engine::registrar_named(arguments.method);
  if (!registrar) return bad_input(registrar.error().message);
  if (const Status s = arguments.json.check(); !s) return bad_input(s.error().message);
  const auto inputs = load(arguments);
  if (!inputs) return bad_input(inputs.error().message);
  engine::RegistrationRequest request{*inputs->model, inputs->points, {}, {}};
  if (inputs->plan) request.screws = inputs->plan->screws;
  const auto registration = (*registrar)(request);
  if (!registration) return bad_input(arguments.points + ": " + registration.error().message);
  if (const Status s = arguments.json.write(as_json(arguments, *inputs, *registration)); !s)
    return bad_input(s.error().message);
  if (!arguments.json.on_stdout()) print(*inputs, *registration);
  for (const std::string& reason : registration->reasons)
    std::fprintf(stderr, "orthonav: refused: %s\n", reason.c_str());
  return registration->accepted ? kDone : kNo;
}

constexpr const char* kFooter =
    "\nExit code 0: accepted; 1: refused, with the reasons on standard error; 2: bad input.\n"
    "The model's axes are the patient's (LPS: +x left, +y posterior, +z superior), its origin is\n"
    "free. The points may be in any frame. model_to_points is a 4x4 matrix for column vectors,\n"
    "by rows: from the model (in its file's axes, in the points' unit) to the points.\n"
    "predicted_tre_mm: root mean square error to expect at the worst of the plan's entries and\n"
    "targets; without a plan, at the model's centre.";

}  // namespace

void add_register_command(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<RegisterArguments>();
  CLI::App* command =
      app.add_subcommand("register", "Registers digitized points to a preoperative model");
  command->add_option("--model", arguments->model, "Vertebra (STL, PLY, OBJ)")
      ->required()
      ->type_name("MESH");
  command
      ->add_option("--points", arguments->points,
                   "Digitized points (CSV x,y,z[,region]; PLY; 3D Slicer markups)")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("--units", arguments->units,
                   "Unit of files that declare none; a model with a plan has the plan's "
                   "[mm]")
      ->check(CLI::IsMember({"mm", "m"}));
  command
      ->add_option("--frame", arguments->frame,
                   "Axes of a model whose file declares none [the plan's, else LPS]")
      ->check(CLI::IsMember({"LPS", "RAS"}));
  command->add_option("--plan", arguments->plan, "Planned screws, for the error to expect there")
      ->type_name("PLAN");
  command->add_option("--method", arguments->method, "registration: best or paper")
      ->capture_default_str();
  command
      ->add_option("--cache", arguments->cache,
                   "Folder that keeps the prepared model for the next time [nothing is kept]")
      ->type_name("DIR");
  arguments->json.add_to(*command);
  command->footer(kFooter);
  command->callback(
      [arguments, &action] { action = [arguments] { return run_register(*arguments); }; });
}

}  // namespace orthonav::tools
