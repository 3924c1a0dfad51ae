#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/live/assembled_operation.h"
#include "hal/igtl/server.h"
#include "tools/igtl_commands.h"

namespace orthonav::tools {

/// `--igtl`, of the commands that run an operation.
struct IgtlArguments {
  std::string at;         ///< "PORT" or "ADDRESS:PORT"; empty: nothing is served
  std::string allow;      ///< networks that may connect besides this machine
  bool commands = false;  ///< clients may command and plan

  void add_to(CLI::App& command);
};

/// Serves an operation over OpenIGTLink (tools/igtl_messages.h) for as long as it lives, once it is
/// open.
class IgtlStream : public engine::LoopObserver {
 public:
  /// What clients ask and what becomes of it is told to `log`, which is borrowed.
  explicit IgtlStream(EventLog& log) : commands_(log) {}
  /// Listens where the arguments say, and says so on standard error; nowhere where they say
  /// nothing.
  Status open(const IgtlArguments& arguments);
  /// From now on what happens in this operation, which must outlive its run; it takes the place of
  /// an earlier one, which has ended.
  void watch(engine::AssembledOperation& operation);

  void stepped(const StereoFrame& frame, const engine::Inputs& inputs,
               const engine::Guidance& guidance) override;
  /// Says on standard error how many clients there were, and why any was dropped.
  void tell() const;

 private:
  IgtlCommands commands_;
  bool hears_ = false;                    ///< clients may command and plan
  std::unique_ptr<igtl::Server> server_;  ///< null: nobody is served
  const engine::Session* session_ = nullptr;
  std::vector<nav::ScrewPlan> told_;  ///< the screws that stand
  std::optional<Timestamp> last_status_;
  std::int64_t sent_at_status_ = -1;  ///< frames that had gone when the last one was made
};

/// "18944"; or "0.0.0.0:18944" with "192.168.1.0/24" allowed.
Result<igtl::ServerOptions> igtl_options(const IgtlArguments& arguments);

}  // namespace orthonav::tools
