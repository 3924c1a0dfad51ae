// How far the touched heads of a rod are off, in whole simulated operations in the measurement
// model: what all heads of a rod share moves the rod as a whole and costs nothing; what is left
// bends it wrongly. The pointer is put exactly on the heads unless --pick-mm says otherwise, so
// that navigation alone is measured.
//   bench_rod_heads --operations 50 --reference --levels L2,L3,L4,L5 > heads.csv
#include <algorithm>
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

#include "engine/case/operation_plan.h"
#include "engine/case/tool_file.h"
#include "engine/phantom/phantom.h"
#include "nav/geometry/absolute_orientation.h"
#include "study/simulated_operation.h"

namespace orthonav {
namespace {

struct Head {
  Vec3 true_m;  ///< in the session's World
  Vec3 touched_m;
};

/// One rod's heads, in the order of touching.
struct Rod {
  nav::Side side = nav::Side::kLeft;
  std::vector<Head> heads;
};

class Listener : public engine::SessionObserver {
 public:
  void listen(const sim::SimHeadset& room, const engine::Session& session) {
    room_ = &room;
    session_ = &session;
  }
  [[nodiscard]] const std::vector<Rod>& rods() const { return rods_; }

  void head_recorded(Timestamp /*time*/, nav::Side side, const engine::HeadTouch& touch) override {
    const Point<World> head = touch.place;
    const Transform<World, sim::Room> world_from_room = true_world_from_room();
    std::optional<Vec3> nearest_m;
    for (const sim::PlacedHead& placed : room_->truth().heads) {
      const Vec3 at_m = (world_from_room * placed.position).v;
      if (placed.side == side &&
          (!nearest_m || (at_m - head.v).norm() < (*nearest_m - head.v).norm())) {
        nearest_m = at_m;
      }
    }
    if (!nearest_m) {
      return;
    }
    if (rods_.empty() || rods_.back().side != side) {
      rods_.push_back({side, {}});
    }
    rods_.back().heads.push_back({*nearest_m, head.v});
  }

 private:
  [[nodiscard]] Transform<World, sim::Room> true_world_from_room() const {
    const nav::Anchor* anchor = session_->tracker().anchor();
    if (anchor == nullptr) {
      return room_->world_from_room();
    }
    // With a reference, World is where the reference was first seen: off as a whole.
    const auto& tools = room_->room().tools;
    const auto reference = std::find_if(tools.begin(), tools.end(), [](const sim::RoomTool& tool) {
      return tool.kind == sim::ToolKind::kReference;
    });
    const auto& room_from_marker =
        room_->state().room_from_marker[static_cast<std::size_t>(reference - tools.begin())];
    return anchor->places.front().anchored_from_marker * room_from_marker.inverse();
  }

  const sim::SimHeadset* room_ = nullptr;
  const engine::Session* session_ = nullptr;
  std::vector<Rod> rods_;
};

/// The true pose in the session's World: what is measured here does not depend on how the bone was
/// registered, and searching for it would take most of the time.
Result<nav::Registration> true_registration(const sim::SimHeadset& room,
                                            const engine::Session& session,
                                            const nav::VertebraModel& model) {
  const auto planned = session.levels();
  const auto level = std::find_if(planned.begin(), planned.end(), [&](const auto& state) {
    return state.plan.model.get() == &model;
  });
  const auto& levels = room.room().levels;
  const auto bone = std::find_if(levels.begin(), levels.end(), [&](const sim::RoomLevel& l) {
    return l.label == level->plan.label;
  });
  const nav::Anchor* anchor = session.tracker().anchor();
  const auto session_from_map =
      anchor != nullptr ? anchor->world_from_anchored.inverse() : Transform<World, World>();
  nav::Registration found;
  found.accepted = true;
  found.world_from_vertebra = found.runner_up = session_from_map * room.world_from_room() *
                                                room.state().room_from_spine *
                                                bone->spine_from_vertebra;
  found.points = 1000;
  return found;
}

Result<std::vector<Rod>> run(const engine::OperationOptions& options,
                             const engine::Operation& planned) {
  Listener listener;
  const engine::Session* opened = nullptr;
  engine::OperationHooks hooks;
  hooks.session = {&listener};
  hooks.adapt = [&](const sim::SimHeadset& room, engine::Method& method) {
    method.registrar = [&](const engine::RegistrationRequest& request) {
      return true_registration(room, *opened, request.model);
    };
  };
  hooks.opened = [&](sim::SimHeadset& room, const engine::Method&, const engine::Session& session) {
    listener.listen(room, session);
    opened = &session;
    return Status();
  };
  const auto result = engine::run_operation(engine::phantom(), planned, options, hooks);
  if (!result) {
    return result.error();
  }
  return listener.rods();
}

/// Sums of squares over rods, with what they are divided by.
struct Spread {
  double squares_m2 = 0.0;
  double count = 0.0;
  void add(Vec3 off_m, double degrees_of_freedom) {
    squares_m2 += off_m.squared_norm();
    count += degrees_of_freedom;
  }
  [[nodiscard]] double sd_mm() const { return 1e3 * std::sqrt(squares_m2 / std::max(1.0, count)); }
};

struct Figures {
  std::size_t rods = 0;
  std::size_t heads = 0;
  Spread whole;       ///< from the true heads
  Spread common;      ///< the mean of a rod
  Spread left;        ///< what the mean leaves
  Spread neighbours;  ///< differences of neighbours, over √2
  Spread laid;        ///< what a rigid motion of all heads leaves
};

void add_laid(Figures& figures, const Rod& rod) {
  std::vector<Vec3> touched;
  std::vector<Vec3> true_ones;
  for (const Head& head : rod.heads) {
    touched.push_back(head.touched_m);
    true_ones.push_back(head.true_m);
  }
  const auto fit = nav::absolute_orientation(touched, true_ones);
  const double n = static_cast<double>(rod.heads.size());
  if (!fit || n < 3.0) {
    return;
  }
  for (std::size_t i = 0; i < touched.size(); ++i) {
    figures.laid.add(fit->rotation * touched[i] + fit->translation_m - true_ones[i],
                     (3.0 * n - 6.0) / n);
  }
}

void add(Figures& figures, const Rod& rod) {
  const double n = static_cast<double>(rod.heads.size());
  Vec3 mean_m;
  for (const Head& head : rod.heads) {
    mean_m += (head.touched_m - head.true_m) / n;
  }
  ++figures.rods;
  figures.heads += rod.heads.size();
  figures.common.add(mean_m, 3.0);
  for (std::size_t i = 0; i < rod.heads.size(); ++i) {
    const Vec3 off_m = rod.heads[i].touched_m - rod.heads[i].true_m;
    figures.whole.add(off_m, 3.0);
    figures.left.add(off_m - mean_m, 3.0 * (n - 1.0) / n);
    if (i > 0) {
      const Vec3 before_m = rod.heads[i - 1].touched_m - rod.heads[i - 1].true_m;
      figures.neighbours.add((off_m - before_m) / std::sqrt(2.0), 3.0);
    }
  }
  add_laid(figures, rod);
}

int run_all(engine::OperationOptions options, std::uint64_t first, int operations) {
  const auto planned = engine::plan_operation(engine::phantom(), options.levels);
  if (!planned) {
    std::fprintf(stderr, "%s\n", planned.error().message.c_str());
    return 2;
  }
  Figures figures;
  std::puts("seed,side,head,x_mm,y_mm,z_mm,off_x_mm,off_y_mm,off_z_mm");
  for (int i = 0; i < operations; ++i) {
    options.sim.seed = first + static_cast<std::uint64_t>(i);
    const auto rods = run(options, *planned);
    if (!rods) {
      std::fprintf(stderr, "%s\n", rods.error().message.c_str());
      return 2;
    }
    for (const Rod& rod : *rods) {
      add(figures, rod);
      for (std::size_t k = 0; k < rod.heads.size(); ++k) {
        const Vec3 at = 1e3 * rod.heads[k].true_m;
        const Vec3 off = 1e3 * (rod.heads[k].touched_m - rod.heads[k].true_m);
        std::printf("%llu,%s,%zu,%.3f,%.3f,%.3f,%.4f,%.4f,%.4f\n",
                    static_cast<unsigned long long>(options.sim.seed),
                    rod.side == nav::Side::kLeft ? "left" : "right", k + 1, at.x, at.y, at.z, off.x,
                    off.y, off.z);
      }
    }
    std::fflush(stdout);
  }
  std::fprintf(
      stderr,
      "%zu rods, %zu heads; SD along an axis, mm: from the true heads %.3f, common to a "
      "rod's heads %.3f, left of them %.3f, between neighbours (over root 2) %.3f, after a "
      "rigid fit %.3f\n",
      figures.rods, figures.heads, figures.whole.sd_mm(), figures.common.sd_mm(),
      figures.left.sd_mm(), figures.neighbours.sd_mm(), figures.laid.sd_mm());
  return 0;
}

}  // namespace
}  // namespace orthonav

int main(int argc, char** argv) {
  CLI::App app("How far the touched heads of a rod are off, as CSV");
  orthonav::engine::OperationOptions options;
  std::uint64_t first = 1;
  int operations = 50;
  double pick_mm = 0.0;
  std::string measurement = "model";
  options.levels = {"L2", "L3", "L4", "L5"};
  app.add_option("--operations", operations, "how many");
  app.add_option("--seed", first, "of the first; those that follow count up");
  app.add_option("--levels", options.levels, "to operate")->delimiter(',');
  app.add_flag("--reference", options.use_reference,
               "positions are relative to a patient reference");
  app.add_option("--pick-mm", pick_mm, "SD of putting the tip on a head");
  app.add_option("--measurement", measurement, "pixels or model")
      ->check(CLI::IsMember({"pixels", "model"}));
  CLI11_PARSE(app, argc, argv);
  options.tools = orthonav::engine::built_in_tools();
  options.loop.draw_every = 0;
  options.sim.error_model.head_pick_m = pick_mm * 1e-3;
  if (measurement == "model") {
    options.measurement = orthonav::engine::Measurement::kModel;
  }
  return orthonav::run_all(options, first, operations);
}
