#include "bench/tag_bound.h"

#include <array>
#include <Eigen/Dense>

#include "bench/tag_pixels.h"

namespace orthonav::bench {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// About half a pixel: greys are whole numbers.
double step_along(std::size_t axis) {
  constexpr double kStep = 0.0006;
  return axis < 3 ? kStep : kStep / 0.02;
}

/// The pictures of a tool that is displaced both ways along each axis of its marker.
struct Displaced {
  std::array<StereoFrame, 6> ahead;
  std::array<StereoFrame, 6> behind;
};

Displaced displaced(const StereoCalibration& c, const Transform<Rig, Marker>& pose,
                    std::size_t tool) {
  sim::ErrorModel error_model = sim::ErrorModel::perfect();
  error_model.blur_sigma_px = 0.7;
  const auto renderer = sim::RoomRenderer::create(tag_room(), error_model);
  sim::RoomState state;
  state.room_from_marker.assign(2, {});
  state.tool_present = {tool == 0, tool == 1};
  const auto drawn = [&](std::size_t axis, double sign) {
    std::array<double, 6> step{};
    step[axis] = sign * step_along(axis);
    const Transform<Marker, Marker> moved(rotation_from_vector({step[3], step[4], step[5]}),
                                          {step[0], step[1], step[2]});
    const Transform<Rig, Marker> there = pose * moved;
    state.room_from_marker[tool] = {there.rotation(), there.translation()};
    StereoFrame frame;
    const std::vector<sim::RoomState> states(1, state);
    renderer->render(states, c.left, c.left_from_rig, 1, frame.left);
    renderer->render(states, c.right, as_camera(c.right_from_rig), 1, frame.right);
    return frame;
  };
  Displaced out;
  for (std::size_t axis = 0; axis < 6; ++axis) {
    out.ahead[axis] = drawn(axis, 1.0);
    out.behind[axis] = drawn(axis, -1.0);
  }
  return out;
}

}  // namespace

std::array<double, 36> cramer_rao_bound(const TagKind& kind, const StereoCalibration& calibration,
                                        const Transform<Rig, Marker>& pose, std::size_t tool) {
  const Displaced tags = displaced(calibration, pose, tool);
  Matrix6 information = Matrix6::Zero();
  const auto gather = [&](const GreyImage StereoFrame::*side, const CameraModel& camera,
                          const auto& camera_from_rig) {
    each_pixel(camera, camera_from_rig, pose, 0.5 * kTagM * 10.0 / 8.0, [&](std::size_t i) {
      Eigen::Matrix<double, 6, 1> slope;
      double light = 0.0;
      for (std::size_t axis = 0; axis < 6; ++axis) {
        const double a = (tags.ahead[axis].*side).pixels[i];
        const double b = (tags.behind[axis].*side).pixels[i];
        slope(static_cast<Eigen::Index>(axis)) = kind.light * (a - b) / (2.0 * step_along(axis));
        light += kind.light * (a + b) / 12.0;
      }
      const double variance = kind.shot * light + kind.read * kind.read + 1.0 / 12.0;
      information += slope * slope.transpose() / variance;
    });
  };
  gather(&StereoFrame::left, calibration.left, calibration.left_from_rig);
  gather(&StereoFrame::right, calibration.right, calibration.right_from_rig);
  const Matrix6 bound = information.inverse();
  std::array<double, 36> out;
  for (int r = 0; r < 6; ++r) {
    for (int c = 0; c < 6; ++c) {
      out[static_cast<std::size_t>(6 * r + c)] = bound(r, c);
    }
  }
  return out;
}

}  // namespace orthonav::bench
