#include "engine/session/registering.h"

#include <utility>

namespace orthonav::engine {

void Registering::watch(WorkWatch* watch) {
  watch_ = watch;
  if (watch_ && under_way_) {
    watch_->begins_beside(Part::kRegistration);
  }
}

RegistrationJob Registering::now(RegistrationJob job) const {
  job.found = registrar_({*job.level.model, job.points, job.level.screws, job.level.neighbours,
                          job.common, job.sds_m, job.shafts});
  return job;
}

void Registering::begin(RegistrationJob job) {
  asked_ = std::move(job);
  if (!under_way_) {
    start();
  }
}

void Registering::forget() {
  asked_.reset();
  wanted_ = false;
}

std::optional<RegistrationJob> Registering::answer() {
  if (!under_way_ || !worker_->idle()) {
    return std::nullopt;
  }
  under_way_ = false;
  {
    const Working working(watch_, Part::kRegistration);
    worker_->wait();
  }
  if (watch_) {
    watch_->ends_beside(Part::kRegistration);
  }
  if (asked_) {
    start();
    return std::nullopt;
  }
  return std::exchange(wanted_, false) ? std::optional(std::move(job_)) : std::nullopt;
}

void Registering::start() {
  if (!worker_) {
    worker_ = std::make_unique<nav::Worker>();
  }
  job_ = *std::exchange(asked_, std::nullopt);
  wanted_ = under_way_ = true;
  if (watch_) {
    watch_->begins_beside(Part::kRegistration);
  }
  worker_->start(
      [](void* raw) {
        auto& self = *static_cast<Registering*>(raw);
        self.job_ = self.now(std::move(self.job_));
      },
      this);
}

}  // namespace orthonav::engine
