#include "tools/orthonav/run/presenting.h"

#include <cstdio>

#include "tools/orthonav/run/run_stats.h"
#include "tools/support/eye_in_rig.h"

namespace orthonav::tools {

Status Presenting::begin(Headset& headset, engine::AssembledOperation& operation) {
  if (headset.pixels() != nullptr) {
    engine::PresenterOptions options;
    options.clock = &headset.clock();
    options.on_over = [&operation] { operation.stop(); };
    auto presenter = engine::Presenter::start(*headset.pixels(), options);
    if (!presenter) {
      return presenter.error();
    }
    presenter_ = std::move(*presenter);
    sink_ = presenter_.get();
  } else if (headset.objects() != nullptr) {
    display_ = headset.objects();
    objects_ =
        std::make_unique<engine::ObjectPresenter>(*display_, headset.head(), rig_from_eyes());
    sink_ = objects_.get();
  }
  operation.draw_into(sink_);
  return {};
}

void Presenting::end(bool stats) {
  if (presenter_) {
    const engine::PresentReport report = presenter_->stop();
    for (const std::string& problem : report.problems) {
      std::fprintf(stderr, "%s\n", problem.c_str());
    }
    if (stats) {
      print_stats(report);
    }
  }
  if (display_ != nullptr && stats) {
    print_stats(display_->statistics());
  }
}

}  // namespace orthonav::tools
