// The headset's own scene (docs/hl2ss.md): how exactly a bone is drawn there with lines, and how
// guidance fares on a link with delay and losses, in simulated time. Usage: bench_remote_scene
// [SECONDS of the link, default 600]

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

#include "base/random.h"
#include "bench/contour_errors.h"
#include "bench/quantile.h"
#include "engine/case/operation_plan.h"
#include "engine/holograms/shapes/render_values.h"
#include "engine/phantom/phantom.h"
#include "render/float3.h"
#include "tests/hal/hl2ss/scene_link.h"

namespace orthonav {
namespace {

using std::chrono::milliseconds;

constexpr double kRotation_rad_s = 0.5236;  // 30 degrees
/// Around a bone 0.5 m away, when the head turns about a neck 0.1 m behind the eyes.
constexpr double kByRotation = 0.2;

void print(const char* what, const ContourErrors& errors) {
  std::printf("%-44s %6zu  %5.2f %5.2f %5.2f   %5.2f %5.2f %5.2f\n", what, errors.drawn_mm.size(),
              quantile(errors.drawn_mm, 0.5), quantile(errors.drawn_mm, 0.95),
              quantile(errors.drawn_mm, 0.99), quantile(errors.missed_mm, 0.5),
              quantile(errors.missed_mm, 0.95), quantile(errors.missed_mm, 0.99));
}

void measure_contours() {
  const auto operation = engine::plan_operation(engine::phantom(), {"L4"});
  if (!operation) {
    std::fprintf(stderr, "%s\n", operation.error().message.c_str());
    return;
  }
  auto bone = *engine::mesh_data(operation->levels[0].model->mesh());
  // Moves the middle to the origin, and turns posterior (+y of LPS) upwards, towards the heads.
  const render::Float3 middle = engine::SurfaceContours(bone).middle();
  for (render::Float3& p : bone.positions) {
    p = p - middle;
  }
  const std::size_t triangles = bone.indices.size() / 3;
  const ContourBench bench(std::make_shared<const render::MeshData>(std::move(bone)));
  std::printf(
      "L4 of the phantom, %zu triangles, 0.5 m away, %.0f pieces; errors across the line of "
      "sight, mm: median, p95, p99\n%-44s %6s  %-17s   %s\n",
      triangles, bench.pieces(), "", "points", "drawn to true", "true to drawn");
  print("at rest, lines", bench.at_rest(false));
  print("at rest, picture on a quad", bench.at_rest(true));
  print("head turns by 30 deg/s, lines", bench.in_motion(kByRotation * kRotation_rad_s, false));
  print("head turns by 30 deg/s, picture on a quad",
        bench.in_motion(kByRotation * kRotation_rad_s, true));
  print("head circles the bone at 30 deg/s, lines", bench.in_motion(kRotation_rad_s, false));
  print("head circles it, picture on a quad", bench.in_motion(kRotation_rad_s, true));
}

/// As while guiding: 41 objects stay in place, 15 hang on a tool and move with each pair.
ObjectList guidance(Timestamp tool_time, Random& random) {
  ObjectList list;
  list.tool_time = tool_time;
  DisplayObject number = test::readout(1, std::to_string(tool_time.time_since_epoch().count()));
  list.objects.push_back(number);
  for (std::uint64_t i = 0; i < 55; ++i) {
    DisplayObject object = test::ball(10 + i, {0.01 * static_cast<double>(i), 0, -0.5});
    object.follows_tool = i < 14;
    if (object.follows_tool) {
      object.position_m.y = random.uniform(-0.01, 0.01);
    }
    list.objects.push_back(object);
  }
  return list;
}

struct LinkFigures {
  std::int64_t frames = 0;
  std::int64_t with_guidance = 0;
  double oldest_ms = 0;  ///< age of the oldest guidance that was seen
};

/// Notes the age of the number that is seen, if any.
void look(const test::SceneLink& link, LinkFigures& figures) {
  ++figures.frames;
  for (const auto& [id, thing] : link.peer.things) {
    if (thing.visible && thing.text) {
      ++figures.with_guidance;
      const Timestamp pair{Duration(std::stoll(thing.words))};
      figures.oldest_ms = std::max(figures.oldest_ms, seconds(link.now() - pair) * 1e3);
    }
  }
}

void measure_link(Duration one_way, double loss, int limit_s) {
  constexpr Duration kUntilTracked = milliseconds(45);  // exposure, transfer, tracking
  constexpr Duration kUntilSentAgain = milliseconds(200);
  test::SceneLink link;
  link.delay(one_way);
  Random random(3);
  LinkFigures figures;
  int frames = link.frames;
  int reconnected = 0;
  for (int ms = 0; ms < 1000 * limit_s; ++ms) {
    if (ms % 33 == 0) {
      link.client.want(guidance(link.now() - kUntilTracked, random));
    }
    if (random.uniform() < loss * 0.0606) {  // some sixty segments a second
      link.lose_next(kUntilSentAgain + 2 * one_way);
    }
    link.step();
    if (std::exchange(frames, link.frames) != link.frames) {
      look(link, figures);
    }
    if (!link.client.overdue(link.host())) {
      link.reconnect();
      ++reconnected;
    }
  }
  const auto statistics = link.client.statistics();
  std::printf(
      "%2lld ms each way, %.0f %% lost  %6zu  %5.0f %5.0f   %6.1f %6.1f   %6.1f %6.1f   "
      "%5.1f %%  %6.1f   %d\n",
      static_cast<long long>(one_way / milliseconds(1)), 100 * loss, statistics.shown_age_ms.size(),
      static_cast<double>(statistics.commands) / limit_s,
      static_cast<double>(link.sent_bytes) / 1e3 / limit_s,
      quantile(statistics.acknowledged_ms, 0.5), quantile(statistics.acknowledged_ms, 0.99),
      quantile(statistics.shown_age_ms, 0.5), quantile(statistics.shown_age_ms, 0.99),
      100.0 * static_cast<double>(figures.with_guidance) / static_cast<double>(figures.frames),
      figures.oldest_ms, reconnected);
}

}  // namespace
}  // namespace orthonav

int main(int argc, char** argv) {
  const int limit_s = argc > 1 ? std::atoi(argv[1]) : 600;
  orthonav::measure_contours();
  std::printf("\n%-25s %6s  %11s   %s\n", "link, counted time", "lists", "commands, kB a second",
              "list to ack, ms | pair to ack, ms | frames with guidance | oldest seen, ms | "
              "connections given up");
  for (const int one_way_ms : {0, 10, 20}) {
    for (const double loss : {0.0, 0.02}) {
      orthonav::measure_link(std::chrono::milliseconds(one_way_ms), loss, limit_s);
    }
  }
  return 0;
}
