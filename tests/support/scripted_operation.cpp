#include "tests/support/scripted_operation.h"

#include <map>
#include <numbers>

namespace orthonav::test {
namespace {

/// Corners of the box's faces at `n` divisions, shared between neighbours.
class BoxMaker {
 public:
  nav::TriangleMesh make(Vec3 half, int n) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {-1.0, 1.0}) {
        add_face(axis, side, half, n);
      }
    }
    return std::move(mesh_);
  }

 private:
  std::uint32_t vertex(Vec3 unit, Vec3 half) {
    const auto key = std::array<long, 3>{std::lround(unit.x * 1000), std::lround(unit.y * 1000),
                                         std::lround(unit.z * 1000)};
    const auto [it, added] =
        known_.try_emplace(key, static_cast<std::uint32_t>(mesh_.vertices_m.size()));
    if (added) {
      mesh_.vertices_m.push_back({unit.x * half.x, unit.y * half.y, unit.z * half.z});
    }
    return it->second;
  }

  void add_face(int axis, double side, Vec3 half, int n) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const auto corner = [&](int i, int j) {
      Vec3 p;
      p[axis] = side;
      p[u] = -1.0 + 2.0 * i / n;
      p[v] = -1.0 + 2.0 * j / n;
      return vertex(p, half);
    };
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const auto a = corner(i, j);
        const auto b = corner(i + 1, j);
        const auto c = corner(i + 1, j + 1);
        const auto d = corner(i, j + 1);
        if (side > 0) {
          mesh_.triangles.insert(mesh_.triangles.end(), {{a, b, c}, {a, c, d}});
        } else {
          mesh_.triangles.insert(mesh_.triangles.end(), {{a, c, b}, {a, d, c}});
        }
      }
    }
  }

  nav::TriangleMesh mesh_;
  std::map<std::array<long, 3>, std::uint32_t> known_;
};

}  // namespace

nav::TriangleMesh box_bone() { return BoxMaker().make({0.030, 0.020, 0.025}, 12); }

std::vector<nav::ScrewPlan> two_screws() {
  nav::ScrewPlan left{nav::Side::kLeft, {{0.015, 0.020, 0.0}}, {{0.015, -0.015, 0.0}}, 0.003};
  nav::ScrewPlan right{nav::Side::kRight, {{-0.015, 0.020, 0.0}}, {{-0.015, -0.015, 0.0}}, 0.003};
  return {left, right};
}

engine::Operation operation_of(const std::vector<std::string>& labels) {
  // Prepared once, because models are never changed.
  static const auto kBone = nav::VertebraModel::prepare(box_bone()).value();
  engine::Operation operation;
  operation.case_name = "boxes";
  operation.rods_alone = labels.empty();
  for (const std::string& label : labels) {
    operation.levels.push_back({label, kBone, two_screws()});
  }
  return operation;
}

ScriptedOperation::ScriptedOperation(std::vector<std::string> labels,
                                     engine::SessionOptions options,
                                     engine::Verification verification, bool coaching,
                                     bool reference,
                                     const std::optional<nav::ToolGeometry>& other) {
  registration.accepted = true;
  registration.rmse_m = 0.0006;
  registration.points = 300;
  auto tracker = std::make_unique<ScriptedTracker>();
  tracker_ = tracker.get();
  if (labels.empty() && !reference && !other) {
    tracker->has_pointer_alone();
  }
  if (reference) {
    tracker->hang_on_reference();
  }
  if (other) {
    tracker->add_other(*other);
  }
  auto registrar = [this](const engine::RegistrationRequest& request) -> Result<nav::Registration> {
    if (before_registering) {
      before_registering();
    }
    registered_points.push_back(request.points_in_world.size());
    if (unusable) {
      return Error{*unusable};
    }
    return registration;
  };
  session_ = engine::Session::create(operation_of(labels), std::move(tracker),
                                     {"scripted", {}, registrar, verification, coaching}, options)
                 .value();
}

const engine::Guidance& ScriptedOperation::pair() {
  now_ += std::chrono::microseconds(33333);
  StereoFrame frame;
  frame.time = now_;
  frame.world_from_rig = Transform<World, Rig>{};
  frame.map_epoch = map_epoch;
  engine::Inputs inputs;
  inputs.clicks = clicks_;
  inputs.phrases = phrases_;
  inputs.requests = requests_;
  inputs.display_time = now_ + latency;
  inputs.stalled = stalled;
  inputs.time_runs = time_runs;
  shown_ = &session_->step(frame, inputs);
  clicks_.clear();
  phrases_.clear();
  requests_.clear();
  return *shown_;
}

const engine::Guidance& ScriptedOperation::pairs(int n) {
  for (int i = 1; i < n; ++i) {
    pair();
  }
  return pair();
}

const engine::Guidance& ScriptedOperation::says(const std::string& phrase, double confidence) {
  phrases_.push_back({phrase, confidence, now_ + std::chrono::milliseconds(1)});
  return pair();
}

const engine::Guidance& ScriptedOperation::asks(engine::Request request) {
  request.time = now_ + std::chrono::milliseconds(1);
  requests_.push_back(std::move(request));
  return pair();
}

void ScriptedOperation::hears_at(Timestamp time, const std::string& phrase, double confidence) {
  phrases_.push_back({phrase, confidence, time});
}

const engine::Guidance& ScriptedOperation::does(std::vector<ClickerAction> actions) {
  for (const ClickerAction action : actions) {
    clicks_.push_back({action, now_ + std::chrono::milliseconds(1)});
  }
  return pair();
}

const engine::Guidance& ScriptedOperation::strokes(int n) {
  does({ClickerAction::kPress});
  pairs(n - 1);
  return does({ClickerAction::kRelease});
}

const engine::Guidance& ScriptedOperation::touches(Vec3 tip) {
  tracker_->pointer = pointer_at(tip);
  does({ClickerAction::kPress});
  pair();
  return does({ClickerAction::kRelease, ClickerAction::kClick});
}

void ScriptedOperation::registers_within(double sd_m) {
  std::array<double, 36> covariance{};
  for (std::size_t k = 0; k < 3; ++k) {
    covariance[7 * k] = sd_m * sd_m;
  }
  registration.uncertainty = nav::PoseUncertainty({0, 0, 0}, covariance);
}

const engine::Guidance& ScriptedOperation::accepts() {
  pair();
  return says("accept");
}

const engine::Guidance& ScriptedOperation::registers_level() {
  tracker_->pointer = pointer_at({0, 0.02, 0});
  strokes(5);
  says("save");
  return does({ClickerAction::kDoubleClick});
}

const engine::Guidance& ScriptedOperation::registers_first_level() {
  tracker_->pointer = pointer_at({0, 0.02, 0});
  says("start");
  return registers_level();
}

const engine::Guidance& ScriptedOperation::finishes_every_screw() {
  says("start");
  const engine::Guidance* last = nullptr;
  for (const engine::LevelState& level : session_->levels()) {
    registers_level();
    accepts();
    last = &says("next");
    for (std::size_t screw = 0; screw < level.plan.screws.size(); ++screw) {
      last = &says("next");
    }
  }
  return *last;
}

const engine::Guidance& ScriptedOperation::checks_by_touch() {
  touches({-0.015, 0.020, -0.010});
  touches({0.015, 0.020, -0.010});
  return touches({0.000, 0.020, 0.012});
}

const engine::Guidance& ScriptedOperation::touches_landmark(Vec3 off_m) {
  const int touches = engine::landmark_touches(tracker_->anchor() != nullptr);
  for (int touch = 1; touch < touches; ++touch) {
    this->touches(kLandmark + off_m);
  }
  return this->touches(kLandmark + off_m);
}

const engine::Guidance& ScriptedOperation::accepts_first_by_touch() {
  registers_first_level();
  checks_by_touch();
  return accepts();
}

const engine::Guidance& ScriptedOperation::accepts_first_level() {
  registers_first_level();
  return accepts();
}

double guide_sd_m() {
  return engine::TipCheck(std::numbers::sqrt2 * engine::PlacedWireRules{}.tip_sd_m)
      .difference_sd_m(0.0, Mat3::identity());
}

}  // namespace orthonav::test
