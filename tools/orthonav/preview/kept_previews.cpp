#include "tools/orthonav/preview/kept_previews.h"

#include <cstdio>
#include <utility>

#include "tools/orthonav/shared/arguments.h"

namespace orthonav::tools {

void KeepArguments::add_to(CLI::App& command) {
  auto* keeps = command.add_option("--keep", keep,
                                   "keep the operation in this folder, so that it can be resumed");
  keeps->check(some_text())->type_name("DIR");
  command
      .add_option("--resume", resume,
                  "go on with the operation that a preview, run or demo left in this folder")
      ->check(some_text())
      ->type_name("DIR")
      ->excludes(keeps);
}

Status KeptPreviews::open(const KeepArguments& arguments) {
  const bool resumes = !arguments.resume.empty();
  if (!resumes && arguments.keep.empty()) {
    return {};
  }
  if (resumes) {
    if (const Status found = kept_.emplace().find(arguments.resume); !found) {
      return Error{"--resume: " + found.error().message, found.error().code};
    }
  }
  auto folder = OutFolder::create(resumes ? "--resume" : "--keep",
                                  resumes ? arguments.resume : arguments.keep);
  if (!folder) {
    return folder.error();
  }
  folder_.emplace(std::move(*folder));
  return {};
}

Status KeptPreviews::begin(engine::AssembledOperation& operation, const std::string& case_name,
                           const engine::SetUp& set_up, const sim::SimHeadset* room) {
  if (!folder_) {
    return {};
  }
  if (!kept_) {
    kept_.emplace();
  }
  KeptOperation::About about;
  about.case_name = case_name;
  about.method = set_up.method;
  about.patient_reference = set_up.reference;
  if (room != nullptr) {
    about.seed = room->options().seed;
  }
  return kept_->begin(operation, folder_->path().string(), about);
}

std::vector<nav::ReferencePlace> KeptPreviews::reference_places() const {
  return kept_ ? kept_->reference_places() : std::vector<nav::ReferencePlace>();
}

void KeptPreviews::ended(const engine::LoopReport& report) {
  if (!kept_) {
    return;
  }
  const std::string reason = report.done    ? ""
                             : report.ended ? "the preview was closed"
                                            : report.ended.error().message;
  if (const Status kept = kept_->finish(report.done, reason); !kept) {
    std::fprintf(stderr, "orthonav: %s\n", kept.error().message.c_str());
  }
  kept_.reset();  // a later start is a separate operation
}

}  // namespace orthonav::tools
