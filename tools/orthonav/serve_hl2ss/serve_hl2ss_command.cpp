#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

#include "base/how_many.h"
#include "engine/case/operation_plan.h"
#include "engine/case/tool_file.h"
#include "hal/api/as_headset.h"
#include "hal/hl2ss/server/server.h"
#include "hal/net/host_port.h"
#include "hal/sim/sim_headset.h"
#include "study/set_up.h"
#include "study/sim_scenario.h"
#include "tools/orthonav/command.h"
#include "tools/orthonav/serve_hl2ss/scene_drawing.h"
#include "tools/orthonav/shared/arguments.h"
#include "tools/orthonav/shared/case_source.h"
#include "tools/orthonav/shared/set_up_arguments.h"
#include "tools/orthonav/shared/stop_signals.h"

namespace orthonav::tools {
namespace {

struct ServeArguments {
  hl2ss::ServerOptions server;
  std::string case_folder;
  std::vector<std::string> levels;
  bool rods_only = false;
  std::uint64_t seed = 1;
  bool perfect = false;
  SetUpArguments set_up;
  double pace = 1.0;
  std::string faults;
  std::int64_t sessions = 0;
  std::string draw;
  std::string film;
};

constexpr auto kLookEvery = std::chrono::milliseconds(20);
/// Every 50th look, once a second.
constexpr int kPictureEvery = 50;

/// Opens the headset for each session: the same simulated operation from its beginning.
Result<hl2ss::Server::OpenHeadset> sessions_of(const ServeArguments& arguments) {
  const auto source = load_checked_case(arguments.case_folder);
  if (!source) {
    return source.error();
  }
  const auto operation = arguments.rods_only
                             ? engine::plan_rods_alone(*source)
                             : engine::plan_without_models(*source, arguments.levels);
  if (!operation) {
    return operation.error();
  }
  const engine::SetUp set_up = arguments.set_up.chosen();
  auto room = engine::room_of(*source, *operation, engine::built_in_tools());
  room.exposure = engine::strokes_of(set_up.method);
  sim::SimOptions options;
  options.seed = arguments.seed;
  if (const Status told = set_up.tell(options); !told) {
    return Error{"--instrument: " + told.error().message};
  }
  if (arguments.perfect) {
    options.error_model = sim::ErrorModel::perfect();
    options.depth_errors = sim::DepthErrors::none();
  }
  options.error_model.pace = arguments.pace;
  options.depth = {DepthStream::kAhat, DepthStream::kLongThrow};
  options.pace = arguments.server.paced ? sim::Pace::kFast : sim::Pace::kRealtime;
  return hl2ss::Server::OpenHeadset(
      [room, options] { return as_headset(sim::SimHeadset::open(room, options)); });
}

void say_where(const hl2ss::Server& server, const ServeArguments& arguments) {
  const hl2ss::ServerOptions& options = arguments.server;
  const std::string side =
      options.standin ? "&standin=" + std::to_string(server.standin_port()) : std::string();
  const engine::SetUp set_up = arguments.set_up.chosen();
  const std::string with = (set_up.method == "best" ? "" : " --method " + set_up.method) +
                           std::string(set_up.reference ? " --reference" : "");
  std::fprintf(stderr,
               "serving a HoloLens 2 at %s, ports from %d on; in another window:\n"
               "  orthonav run --headset 'hl2ss://%s?port=%d%s'%s\n",
               options.host.c_str(), server.first_port(), net::before_port(options.host).c_str(),
               server.first_port(), side.c_str(), with.c_str());
}

/// Draws what the headset's scene shows, a picture a second while it shows anything, and films it.
class SceneWatch {
 public:
  static Result<SceneWatch> create(const ServeArguments& arguments) {
    SceneWatch watch;
    if (!arguments.draw.empty()) {
      auto pictures = ScenePictures::create(arguments.draw);
      if (!pictures) {
        return pictures.error();
      }
      watch.pictures_ = std::move(*pictures);
    }
    if (!arguments.film.empty()) {
      auto film = SceneFilm::create(arguments.film);
      if (!film) {
        return film.error();
      }
      watch.film_ = std::move(*film);
    }
    return watch;
  }
  Status look(hl2ss::Server& server, const hl2ss::ServerReport& report) {
    const bool picture = pictures_ && looks_++ % kPictureEvery == 0;
    if (!report.world_from_rig || !(picture || film_)) {
      return {};
    }
    const hl2ss::UnityObjects objects = server.scene().objects();
    if (film_) {
      if (const Status filmed = film_->look(objects, *report.world_from_rig); !filmed) {
        return filmed;
      }
    }
    return picture && !objects.empty() ? pictures_->draw(objects, *report.world_from_rig)
                                       : Status{};
  }
  Status finish() { return film_ ? film_->finish() : Status{}; }

 private:
  std::unique_ptr<ScenePictures> pictures_;
  std::unique_ptr<SceneFilm> film_;
  int looks_ = 0;
};

/// Reports the beginning and end of each session, until the given number is reached.
int watch(hl2ss::Server& server, SceneWatch& scene, std::int64_t sessions,
          const StopSignals& signals) {
  bool was_streaming = false;
  std::int64_t pairs_before = 0;
  std::int64_t faults_before = 0;
  for (;;) {
    std::this_thread::sleep_for(kLookEvery);
    const hl2ss::ServerReport report = server.report();
    if (report.is_streaming && !was_streaming) {
      std::fprintf(stderr, "session %lld begins\n", static_cast<long long>(report.sessions));
    }
    if (!report.is_streaming && was_streaming) {
      std::fprintf(stderr, "session %lld ended: %s, %s on purpose\n",
                   static_cast<long long>(report.sessions),
                   how_many(report.pairs - pairs_before, "pair").c_str(),
                   how_many(report.faults - faults_before, "fault").c_str());
      pairs_before = report.pairs;
      faults_before = report.faults;
    }
    if (!report.is_streaming && report.sessions == 0 && !report.last_trouble.empty()) {
      return bad_input(report.last_trouble);
    }
    was_streaming = report.is_streaming;
    if (const Status drawn = scene.look(server, report); !drawn) {
      return bad_input(drawn.error().message);
    }
    if (const auto signal = signals.caught()) {
      std::fprintf(stderr, "orthonav: stopped by %s after %s, %s\n", signal->c_str(),
                   how_many(report.sessions, "session").c_str(),
                   how_many(report.pairs, "pair").c_str());
      return signals.exit_code();
    }
    if (sessions > 0 && report.sessions >= sessions && !report.is_streaming) {
      // The last packets are still on their way.
      std::this_thread::sleep_for(std::chrono::milliseconds(500));
      return kDone;
    }
  }
}

int serve(ServeArguments arguments, StopSignals& signals) {
  signals.outlast_terminal();
  const auto faults = hl2ss::faults_of(arguments.faults);
  if (!faults) {
    return bad_input("--faults: " + faults.error().message);
  }
  const auto place = net::host_and_port(arguments.server.host);
  if (!place || place->port) {
    return bad_input("--host \"" + arguments.server.host +
                     "\": " + (place ? "--port names the first port" : place.error().message));
  }
  arguments.server.host = place->host;
  arguments.server.faults = *faults;
  arguments.server.seed = arguments.seed;
  const auto sessions = sessions_of(arguments);
  if (!sessions) {
    return bad_input(sessions.error().message);
  }
  auto scene = SceneWatch::create(arguments);
  if (!scene) {
    return bad_input(scene.error().message);
  }
  const auto server = hl2ss::Server::start(arguments.server, *sessions);
  if (!server) {
    return bad_input(server.error().message);
  }
  signals.let_finish();
  say_where(**server, arguments);
  const int code = watch(**server, *scene, arguments.sessions, signals);
  const Status finished = scene->finish();
  return finished ? code : bad_input(finished.error().message);
}

/// Where it listens, and to whom.
void add_ports(CLI::App& serve, ServeArguments& arguments) {
  hl2ss::ServerOptions& server = arguments.server;
  serve
      .add_option("--port", server.first_port,
                  "first port (a HoloLens 2: 3800; the side channel is 19 higher)")
      ->check(whole_number(1))
      ->capture_default_str();
  serve
      .add_option("--host,--listen", server.host,
                  "address to listen at; 0.0.0.0: for other machines too, if --allow names them")
      ->check(some_text())
      ->capture_default_str();
  serve
      .add_option("--allow", server.allow,
                  "who may connect besides this machine, as in 192.168.1.0/24,10.0.0.7")
      ->check(some_text())
      ->type_name("NETWORKS");
}

/// Options for faults that real headsets have, and the stand-in only on request.
void add_faults(CLI::App& serve, ServeArguments& arguments) {
  serve
      .add_option(
          "--faults", arguments.faults,
          "probabilities for each pair: gap=P, lose=P, unlocated=P, stall=P, "
          "half=P, cut=P, misstamp=P, corrupt=P; for each frame of the scene: scene_stall=P, "
          "scene_refuse=P, scene_cut=P; all: 0.01 of each; jump=N: World jumps at pair N; from "
          "pair N on, for lasting=M pairs (0: to the end): freeze_pictures=N, freeze_left=N, "
          "freeze_right=N, freeze_poses=N, shift_right=N (stamps a pair late), only_left=N, "
          "clock_back=N (by clock_back_s=0.5)")
      ->check(some_text())
      ->type_name(
          "LIST|gap=|lose=|unlocated=|reorder=|stall=|half=|cut=|misstamp=|corrupt=|scene_stall=|"
          "scene_refuse=|scene_cut=|all|jump=|lasting=|freeze_pictures=|freeze_left=|"
          "freeze_right=|freeze_poses=|shift_right=|only_left=|clock_back=|clock_back_s=");
  serve.add_option("--slices", arguments.server.slices, "of each H.264 picture")
      ->check(whole_number(1))
      ->capture_default_str();
  serve
      .add_option("--unmapped-edge-px", arguments.server.unmapped_edge_px,
                  "pixels along the edges without a direction in the calibration")
      ->check(whole_number(0))
      ->capture_default_str();
}

void add_scene(CLI::App& serve, ServeArguments& arguments) {
  serve
      .add_option("--draw", arguments.draw,
                  "folder for pictures of what the headset's own scene shows, one a second")
      ->check(some_text());
  serve.add_option("--film", arguments.film, "film of it, as an MP4 file, ten pictures a second")
      ->check(some_text())
      ->type_name("FILE");
}

}  // namespace

void add_serve_hl2ss_command(CLI::App& app, Action& action, StopSignals& signals) {
  auto arguments = std::make_shared<ServeArguments>();
  auto* serve_hl2ss = app.add_subcommand(
      "serve-hl2ss", "A stand-in for a HoloLens 2: a simulated operation over hl2ss's protocol");
  hl2ss::ServerOptions& server = arguments->server;
  add_ports(*serve_hl2ss, *arguments);
  add_case_option(*serve_hl2ss, arguments->case_folder);
  add_rods_only_flag(*serve_hl2ss, arguments->rods_only,
                     *add_levels_option(*serve_hl2ss, arguments->levels));
  serve_hl2ss->add_option("-s,--seed", arguments->seed, "of the simulation and the faults")
      ->capture_default_str();
  arguments->set_up.add_to(*serve_hl2ss);
  serve_hl2ss->add_flag("--perfect", arguments->perfect, "a room without noise or error");
  serve_hl2ss->add_option("--pace", arguments->pace, "of the surgeon, 1: as most people work")
      ->capture_default_str();
  serve_hl2ss->add_flag("--paced", server.paced,
                        "the next pair comes when the client is done with the last one, as fast as "
                        "it can (default: 30 pairs a second)");
  add_faults(*serve_hl2ss, *arguments);
  add_scene(*serve_hl2ss, *arguments);
  serve_hl2ss
      ->add_option("--sessions", arguments->sessions, "end after so many sessions (0: no end)")
      ->check(whole_number(0))
      ->capture_default_str();
  serve_hl2ss->callback([arguments, &action, &signals] {
    action = [arguments, &signals] { return serve(*arguments, signals); };
  });
}

}  // namespace orthonav::tools
