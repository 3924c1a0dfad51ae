#include "bench/other_sequences.h"

#include <cmath>
#include <Eigen/Dense>
#include <memory>

#include "bench/other_stage.h"

namespace orthonav::bench {
namespace {

constexpr double kPairS = 1.0 / 30.0;
constexpr double kTipM = 0.150;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Stage and renderer of a sequence, kept so that it can be rendered again for the bound.
struct Shoot {
  OtherStage stage;
  OtherRenderer renderer;

  Shoot(const OtherKind& kind, std::uint64_t seed)
      : stage(kind, seed), renderer(stage.tags(), kind.optics, kind.lighting, seed) {}
};

/// Adds the information that one camera's pixels hold about a tool's pose at a time.
void add_information(Shoot& shoot, double t, std::size_t camera, std::size_t tool,
                     Matrix6& information) {
  const OtherStage& stage = shoot.stage;
  const std::vector<Moment> moments = stage.exposure(t);
  const RayGrid& rays = stage.rays()[camera];
  // Moves the image by a quarter of a pixel.
  const double step_m = 0.25 * stage.kind().distance_m / rays.lens().f_px;
  const double step_rad = step_m / (0.5 * stage.kind().tag_m);
  const auto rendered = [&](std::size_t axis, double sign) {
    std::array<double, 6> step{};
    step[axis] = sign * (axis < 3 ? step_m : step_rad);
    const Transform<Marker, Marker> moved(rotation_from_vector({step[3], step[4], step[5]}),
                                          {step[0], step[1], step[2]});
    std::vector<Moment> displaced = moments;
    for (Moment& moment : displaced) {
      moment.world_from_marker[tool] = moment.world_from_marker[tool] * moved;
    }
    LightImage image;
    shoot.renderer.render_tag(displaced, rays, stage.camera_from_rig()[camera], tool, image);
    return image.light;
  };
  std::vector<std::array<float, 6>> slopes;
  std::vector<float> light;
  for (std::size_t axis = 0; axis < 6; ++axis) {
    const auto ahead = rendered(axis, 1.0);
    const auto behind = rendered(axis, -1.0);
    slopes.resize(ahead.size());
    light.resize(ahead.size());
    const auto across = static_cast<float>(2.0 * (axis < 3 ? step_m : step_rad));
    for (std::size_t i = 0; i < ahead.size(); ++i) {
      // A pixel at the rim of what was rendered is missing in one of the two.
      const bool both = ahead[i] > 0.0F && behind[i] > 0.0F;
      slopes[i][axis] = both ? (ahead[i] - behind[i]) / across : 0.0F;
      light[i] += (ahead[i] + behind[i]) / 12.0F;
    }
  }
  const Sensor& sensor = stage.kind().sensor;
  for (std::size_t i = 0; i < light.size(); ++i) {
    if (!(light[i] > 0.0F)) {
      continue;
    }
    constexpr double kStep = 1e-4;
    const auto l = static_cast<double>(light[i]);
    const double by_light = (sensor.grey(l + kStep) - sensor.grey(l - kStep)) / (2.0 * kStep);
    Eigen::Matrix<double, 6, 1> slope;
    for (std::size_t axis = 0; axis < 6; ++axis) {
      slope(static_cast<Eigen::Index>(axis)) = by_light * static_cast<double>(slopes[i][axis]);
    }
    information += slope * slope.transpose() / sensor.variance(l);
  }
}

std::array<double, 36> bound(Shoot& shoot, double t, std::size_t tool) {
  Matrix6 information = Matrix6::Zero();
  for (const std::size_t camera : {0U, 1U}) {
    add_information(shoot, t, camera, tool, information);
  }
  std::array<double, 36> out;
  Eigen::Map<Matrix6>(out.data()) = information.inverse();
  return out;
}

nav::ToolGeometry geometry(const PrintedTag& tag, const char* name, nav::ToolRole role) {
  nav::ToolGeometry tool;
  tool.name = name;
  tool.role = role;
  tool.marker = {"tag36h11", tag.id, tag.size_m};
  tool.tip_in_marker = {{0.0, -kTipM, 0.0}};
  return tool;
}

StereoFrame photographed(Shoot& shoot, int k, Random& random) {
  const OtherStage& stage = shoot.stage;
  const double t = k * kPairS;
  const std::vector<Moment> moments = stage.exposure(t);
  StereoFrame frame;
  frame.sequence = k;
  frame.time = Timestamp(from_seconds(t + 1.0));
  frame.world_from_rig = stage.at(t).world_from_rig;
  LightImage light;
  for (const std::size_t camera : {0U, 1U}) {
    shoot.renderer.render(moments, stage.rays()[camera], stage.camera_from_rig()[camera], light);
    stage.kind().sensor.expose(light, random, camera == 0 ? frame.left : frame.right);
  }
  return frame;
}

}  // namespace

std::vector<std::string> other_sequence_names() {
  std::vector<std::string> names;
  for (const OtherKind& kind : other_kinds()) {
    names.push_back(kind.name);
  }
  return names;
}

Sequence make_other_sequence(const std::string& name, int pairs, std::uint64_t seed) {
  const OtherKind* kind = &other_kinds().front();
  for (const OtherKind& other : other_kinds()) {
    if (other.name == name) {
      kind = &other;
    }
  }
  const auto shoot = std::make_shared<Shoot>(*kind, seed);
  const OtherStage& stage = shoot->stage;
  Sequence out;
  out.name = kind->name;
  out.calibration = stage.calibration();
  out.tools = {geometry(stage.tags()[0], "pointer", nav::ToolRole::kPointer),
               geometry(stage.tags()[1], "guide", nav::ToolRole::kGuide)};
  Random random = Random(seed).fork("noise");
  for (int k = 0; k < pairs; ++k) {
    out.frames.push_back(photographed(*shoot, k, random));
    const Moment middle = stage.at(k * kPairS);
    auto& poses = out.rig_from_marker.emplace_back();
    auto& visible = out.visible.emplace_back();
    for (std::size_t tool = 0; tool < 2; ++tool) {
      poses.push_back(middle.world_from_rig.inverse() * middle.world_from_marker[tool]);
      const auto fraction = [&](std::size_t camera) {
        return shoot->renderer.visible_fraction(middle, stage.rays()[camera].lens(),
                                                stage.camera_from_rig()[camera], tool);
      };
      visible.push_back({fraction(0), fraction(1)});
    }
  }
  out.bound = [shoot](std::size_t pair, std::size_t tool) {
    return bound(*shoot, static_cast<double>(pair) * kPairS, tool);
  };
  return out;
}

}  // namespace orthonav::bench
