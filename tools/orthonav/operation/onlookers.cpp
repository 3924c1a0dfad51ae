#include "tools/orthonav/operation/onlookers.h"

#include <cstdio>

namespace orthonav::tools {

void OnlookerArguments::add_to(CLI::App& command) {
  igtl.add_to(command);
  web.add_to(command);
  // Here, so that event_log.cpp reads the headers of spdlog alone, not those of CLI11 as well.
  command.add_option("--log", log.file, "adds what happens to this file, line by line")
      ->type_name("FILE");
  command.add_flag("--verbose", log.verbose,
                   "also which tool was lost and found, and all of it on standard error");
}

Status Onlookers::open(const OnlookerArguments& arguments) {
  if (const Status opened = log_.open(arguments.log); !opened) {
    return opened;
  }
  if (const Status opened = web_.open(arguments.web); !opened) {
    return opened;
  }
  return igtl_.open(arguments.igtl);
}

void Onlookers::watch(engine::AssembledOperation& operation, const engine::GradeLimits& limits) {
  operation.observe(&log_);
  web_.watch(operation, limits);
  igtl_.watch(operation);
}

void Onlookers::draw_over_camera(engine::AssembledOperation& operation, const StereoCamera* cameras,
                                 engine::SnapshotSink* display) {
  if (!web_.is_open() || cameras == nullptr) {
    return;
  }
  look_through(cameras->calibration());
  view_ = std::make_unique<CameraView>(
      cameras->calibration(), display,
      CameraView::Onlooker{[this] { return web_.looked_at(); },
                           [this](const RgbaImage& picture) {
                             web_.show(picture, "left camera with the holograms");
                           }});
  operation.observe(static_cast<engine::LoopObserver*>(view_.get()));
  operation.draw_into(view_.get());
}

Status Onlookers::Pictures::picture(const RgbaImage& image, const engine::Snapshot& /*snapshot*/) {
  if (web_.looked_at()) {
    web_.show(image, "what the surgeon sees");
  }
  return {};
}

void Onlookers::ended(const engine::LoopReport& report) {
  log_.ended(report);
  if (view_ && !view_->problem().empty()) {
    std::fprintf(stderr, "orthonav: the dashboard showed the left camera alone: %s\n",
                 view_->problem().c_str());
  }
  igtl_.tell();
}

}  // namespace orthonav::tools
