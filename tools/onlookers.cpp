#include "tools/onlookers.h"

namespace orthonav::tools {

void OnlookerArguments::add_to(CLI::App& command) {
  igtl.add_to(command);
  web.add_to(command);
  log.add_to(command);
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

void Onlookers::ended(const engine::LoopReport* report) {
  if (report != nullptr) {
    log_.ended(*report);
  }
  igtl_.tell();
}

}  // namespace orthonav::tools
