#include "tools/orthonav/dashboard/dashboard.h"
#include "tools/orthonav/shared/arguments.h"

namespace orthonav::tools {

void DashboardArguments::add_to(CLI::App& command) {
  command
      .add_option("--web", at,
                  "shows the operation in a browser of this machine, at this port (0: any), or of "
                  "others at ADDRESS:PORT")
      ->check(some_text())
      ->type_name("PORT");
  command
      .add_option("--token", token_file,
                  "file with the token that a browser must bring to --web, made where there is "
                  "none; needed where other machines reach the address")
      ->check(some_text())
      ->type_name("FILE");
}

}  // namespace orthonav::tools
