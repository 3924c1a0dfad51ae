#include "study/stated_navigation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hal/sim/room/noise.h"
#include "study/modelled_tracker.h"

namespace orthonav::engine {
namespace {

/// The level of the room to which a model belongs.
struct KnownModel {
  const nav::VertebraModel* model = nullptr;
  std::string label;
};

std::vector<KnownModel> models_of(const Operation& operation) {
  std::vector<KnownModel> models;
  for (const OperatedLevel& level : operation.levels) {
    models.push_back({level.model.get(), level.label});
  }
  return models;
}

Vec3 middle_of(std::span<const nav::ScrewPlan> screws) {
  Vec3 sum;
  for (const nav::ScrewPlan& screw : screws) {
    sum += 0.5 * (screw.entry.v + screw.target.v);
  }
  return screws.empty() ? sum : sum / static_cast<double>(screws.size());
}

Result<nav::Registration> registered(const StatedNavigation& stated, const sim::SimHeadset& room,
                                     const std::vector<KnownModel>& models,
                                     const RegistrationRequest& request) {
  const auto known = std::find_if(models.begin(), models.end(),
                                  [&](const KnownModel& m) { return m.model == &request.model; });
  if (known == models.end()) {
    return Error{"stated navigation: a model of no level"};
  }
  const auto room_from_vertebra = sim::room_from_level(room.room(), room.state(), known->label);
  if (!room_from_vertebra) {
    return Error{"stated navigation: the room has no level " + known->label};
  }
  const auto truth = room.world_from_room() * *room_from_vertebra;
  Random random = Random(room.options().seed).fork("stated navigation").fork(known->label);
  const Vec3 off_m = sim::normal_vector(random, stated.target_m / std::sqrt(3.0));
  const Mat3 rotation = rotation_from_vector(sim::normal_vector(random, stated.angle_rad));
  const Vec3 middle = middle_of(request.screws);
  const Transform<Vertebra, Vertebra> error{rotation, middle + off_m - rotation * middle};
  nav::Registration out;
  out.accepted = true;
  out.world_from_vertebra = out.runner_up = truth * error;
  out.points = request.points_in_world.size();
  out.predicted_tre_m = stated.target_m;
  return out;
}

}  // namespace

Method method_of(const StatedNavigation& stated, const sim::SimHeadset& room,
                 const Operation& operation) {
  Method method;
  method.name = "stated";
  method.create_tracker = [&room](const auto&... given) {
    return create_modelled_tracker("best", room, given...);
  };
  method.registrar = [stated, &room,
                      models = models_of(operation)](const RegistrationRequest& request) {
    return registered(stated, room, models, request);
  };
  method.verification = Verification::kByEye;
  return method;
}

}  // namespace orthonav::engine
