#include <gmock/gmock.h>

#include <algorithm>
#include <numbers>

#include "engine/case/tool_file.h"
#include "engine/session/log/observer_list.h"
#include "engine/session/workflow/commands.h"
#include "hal/api/forwarding_headset.h"
#include "hal/hl2ss/hl2ss_headset.h"
#include "hal/hl2ss/server/server.h"
#include "nav/evaluation/errors.h"
#include "study/evaluation.h"
#include "study/sim_scenario.h"
#include "study/simulated_operation.h"
#include "study/surgeon/scripted_surgeon.h"
#include "study/surgeon/written_frame.h"
#include "tests/e2e/planned.h"

namespace orthonav::engine::hl2ss_operation_test {
namespace {

// As for the direct run in a perfect world; single precision of poses and calibration adds less
// than a hundredth of it.
constexpr double kPerfectAngle_deg = 0.3;
constexpr double kPerfectEntry_m = 0.0003;
// H.264 at 12 Mbit/s moves a tag's edges by a small part of a pixel.
constexpr double kCodecEntry_m = 0.0006;
constexpr double kCodecAngle_deg = 0.6;

/// A wire as it was driven, against its plan.
struct Wire {
  std::string side;
  double angle_deg = 0.0;
  double entry_m = 0.0;
};

/// Passes everything on, and keeps the wires when its session ends.
class Witnessed : public ForwardingHeadset {
 public:
  Witnessed(std::unique_ptr<sim::SimHeadset> inner, sim::Truth& truth)
      : ForwardingHeadset(*inner), inner_(std::move(inner)), truth_(truth) {}
  ~Witnessed() override { truth_ = inner_->truth(); }

 private:
  std::unique_ptr<sim::SimHeadset> inner_;
  sim::Truth& truth_;
};

/// Steps at which the map was found to have moved, and whether anything of it was shown then.
class MapLog : public SessionObserver {
 public:
  std::vector<Step> moved;
  void happened(Timestamp, Step from, Event event, Cell) override {
    if (event == Event::kMapMoved) {
      moved.push_back(from);
    }
  }
};

struct Operated {
  OperationResult result;
  std::vector<Wire> wires;
  std::vector<Step> map_moves;
  ConnectionStatistics statistics;
};

/// One level from pixels over TCP, by a brisk surgeon in a perfect world.
Operated operate(hl2ss::VideoProfile profile, const hl2ss::Faults& faults, double pace) {
  Operated done;
  const Case& spine = lumbar_spine();
  Operation operation = planned({"L5"});
  const auto plans = operation.levels[0].screws;
  const auto model = operation.levels[0].model;
  const auto room = room_of(spine, operation, built_in_tools());
  sim::SimOptions sim;
  sim.error_model = sim::ErrorModel::perfect();
  sim.error_model.pace = pace;
  sim.surgeon = sim::ScriptedSurgeon::bring;
  sim::Truth truth;
  hl2ss::ServerOptions options;
  options.first_port = 0;
  options.paced = true;
  options.faults = faults;
  auto server = *hl2ss::Server::start(options, [&]() -> Result<std::unique_ptr<Headset>> {
    auto opened = sim::SimHeadset::open(room, sim);
    if (!opened) {
      return opened.error();
    }
    return std::unique_ptr<Headset>(std::make_unique<Witnessed>(std::move(*opened), truth));
  });
  hl2ss::Hl2ssOptions client = server->client_options();
  client.profile = profile;
  client.phrases = headset_phrases();
  auto headset = hl2ss::Hl2ssHeadset::open(client);
  EXPECT_TRUE(headset.ok()) << headset.error().message;
  if (!headset) {
    return done;
  }
  AssemblyOptions assembly;
  assembly.loop.draw_every = 0;
  const ErrorSd none{0.0, ErrorSource::kRoom};
  assembly.errors = {none, none, {}, none};
  auto assembled = *assemble_operation(**headset, std::move(operation), *method_named("best"),
                                       built_in_tools(), assembly);
  sim::ShownToWearer to_wearer(**headset);
  assembled->observe(&to_wearer);
  MapLog map_log;
  assembled->observe(&map_log);
  auto report = assembled->run();
  EXPECT_TRUE(report.ended.ok()) << report.ended.error().message;
  if (!report.ended) {
    return done;
  }
  done.result = result_of(assembled->session().operation(), report);
  done.statistics = (*headset)->statistics();
  done.map_moves = map_log.moved;
  headset->reset();
  server.reset();
  for (const sim::DrivenWire& wire : truth.wires) {
    for (const nav::ScrewPlan& plan : plans) {
      if (wire.side != plan.side) {
        continue;
      }
      const nav::ScrewError error =
          nav::screw_error(plan, {wire.entry, wire.direction}, model->surface());
      done.wires.push_back({name_of(wire.side), error.angle_rad * 180.0 / std::numbers::pi,
                            error.entry_m.value_or(1.0)});
    }
  }
  return done;
}

void expect_wires_within(double angle_deg, double entry_m, const std::vector<Wire>& wires) {
  for (const Wire& wire : wires) {
    EXPECT_LT(wire.angle_deg, angle_deg) << wire.side;
    EXPECT_LT(wire.entry_m, entry_m) << wire.side;
  }
}

TEST(OverTcp, H264AWholeOperationIsExactWithinTheCodecsNoise) {
  const Operated done = operate(hl2ss::VideoProfile::kH264Base, {}, 10.0);
  EXPECT_TRUE(done.result.completed);
  ASSERT_EQ(done.wires.size(), 2u);
  expect_wires_within(kCodecAngle_deg, kCodecEntry_m, done.wires);
  EXPECT_TRUE(done.map_moves.empty());
}

/// Every fault at once, and a world that jumps while a screw is being guided: the level is
/// registered anew, and the wires are as true as those of the direct run in a perfect world.
TEST(OverTcp, RawIsAsExactAsTheDirectRunThroughEveryFaultAndAJumpWhileGuiding) {
  hl2ss::Faults faults = *hl2ss::faults_of("all");
  faults.stall = 0.002;  // a third of a second each
  faults.jump_at = {580};
  const Operated done = operate(hl2ss::VideoProfile::kRaw, faults, 10.0);
  EXPECT_TRUE(done.result.completed);
  EXPECT_THAT(done.map_moves, ::testing::ElementsAre(Step::kGuide));
  EXPECT_GE(done.wires.size(), 2u);
  expect_wires_within(kPerfectAngle_deg, kPerfectEntry_m, done.wires);
}

}  // namespace
}  // namespace orthonav::engine::hl2ss_operation_test
