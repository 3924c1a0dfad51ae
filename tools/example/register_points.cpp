// Registers points on a bone to its model, and says whether to rely on it.
//   register_points            points drawn from the built-in L4, laid somewhere else, with noise
//   register_points POINTS     points that a pointer took of it (CSV x,y,z in mm, in any frame)
#include <orthonav/engine/case/points_file.h>
#include <orthonav/engine/phantom/phantom.h>
#include <orthonav/engine/session/text/wording.h>
#include <orthonav/nav/guidance/predicted_error.h>
#include <random>

#include "must.h"

using namespace orthonav;

/// Every tenth corner of what a pointer can reach, 0.2 mm off along each axis (SD).
std::vector<Point<World>> drawn_from(const nav::VertebraModel& model) {
  const Transform<World, Vertebra> world_from_vertebra(rotation_from_vector({0.2, -0.4, 1.0}),
                                                       {0.1, 0.2, -0.3});
  std::mt19937 random(1);
  std::normal_distribution<double> noise_m(0.0, 0.0002);
  std::vector<Point<World>> points;
  const auto& corners = model.reachable().vertices_m;
  for (std::size_t i = 0; i < corners.size(); i += 10) {
    points.push_back(world_from_vertebra * Point<Vertebra>{corners[i]} +
                     Vec3{noise_m(random), noise_m(random), noise_m(random)});
  }
  return points;
}

std::vector<Point<World>> read(const std::string& path) {
  std::vector<Point<World>> points;
  for (const Vec3& p : must(engine::load_points(path)).points) {
    points.push_back({1e-3 * p});
  }
  return points;
}

int main(int argc, char** argv) {
  const engine::CaseLevel level = engine::phantom({"L4"}).levels.front();
  const auto model = must(nav::VertebraModel::prepare(level.mesh));
  const auto points = argc > 1 ? read(argv[1]) : drawn_from(*model);
  nav::PoseSearchRegistrationOptions options;
  options.targets = nav::entries_and_targets(level.screws);
  const nav::Registration found = must(nav::register_by_pose_search(*model, points, options));
  std::printf("%zu points: %s, error to expect at the screws %.2f mm\n", found.points,
              found.accepted ? "accepted" : "refused", found.predicted_tre_m * 1e3);
  for (const nav::RefusalReason& reason : found.reasons) {
    std::printf("  %s\n", engine::text_of(reason).c_str());
  }
  const auto matrix = found.world_from_vertebra.row_major();
  for (std::size_t row = 0; row < 16; row += 4) {
    std::printf("%9.5f %9.5f %9.5f %9.5f\n", matrix[row], matrix[row + 1], matrix[row + 2],
                matrix[row + 3]);
  }
  return found.accepted ? 0 : 1;
}
