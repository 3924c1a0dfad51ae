#include "tools/preview/live_operation.h"

#include <algorithm>
#include <utility>

#include "engine/case/operation_plan.h"
#include "engine/case/tool_file.h"
#include "engine/holograms/shapes/render_values.h"
#include "engine/live/known_tools.h"
#include "engine/session/text/wording.h"
#include "engine/session/workflow/commands.h"
#include "study/sim_scenario.h"
#include "study/surgeon/scripted_surgeon.h"
#include "tools/support/eye_in_rig.h"

namespace orthonav::preview {
namespace {

engine::LoopOptions loop_options() {
  engine::LoopOptions options;
  // A headset that is paused while its clock runs on is not lost.
  options.longest_silence = std::chrono::hours(24);
  // Nothing is drawn in the loop: the newest moment counts.
  options.real_time = true;
  return options;
}

ToolSeen seen(const nav::ToolGeometry& tool, const nav::TrackedPose& pose) {
  ToolSeen seen{tool.name, pose.status, translation_sigma_m(pose.covariance), {}, {}};
  if (pose.status == PoseStatus::kLost) {
    return seen;
  }
  const double half = 0.5 * tool.marker.size_m;
  const std::array<Vec3, 4> corners = {
      {{-half, half, 0.0}, {half, half, 0.0}, {half, -half, 0.0}, {-half, -half, 0.0}}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    seen.tag_in_world[i] = pose.value * Point<Marker>{corners[i]};
  }
  seen.tip_in_world = pose.value * tool.tip_in_marker;
  return seen;
}

/// A recording of a pointer alone can be looked at as well: it gets the built-in guide, which is
/// never seen in it.
std::vector<nav::ToolGeometry> with_guide(std::vector<nav::ToolGeometry> tools) {
  const auto is_guide = [](const nav::ToolGeometry& tool) {
    return tool.role == nav::ToolRole::kGuide;
  };
  if (std::none_of(tools.begin(), tools.end(), is_guide)) {
    std::vector<nav::ToolGeometry> built_in = engine::built_in_tools();
    tools.push_back(std::move(*std::find_if(built_in.begin(), built_in.end(), is_guide)));
  }
  return tools;
}

}  // namespace

Result<std::unique_ptr<LiveOperation>> LiveOperation::open(const OperationSource& source,
                                                           const sim::SimOptions& room, Gate& gate,
                                                           Keyboard& keyboard, Timeline& timeline) {
  OpenOptions options;
  options.room = engine::room_of(source.source, source.operation, engine::built_in_tools());
  options.room.exposure = engine::strokes_of(source.method.name);
  options.sim = room;
  options.sim.surgeon = sim::ScriptedSurgeon::bring;
  options.phrases = engine::headset_phrases();
  auto opened = open_with_room(source.headset, options);
  if (!opened) {
    return opened.error();
  }
  if (opened->headset->pixels() != nullptr) {
    return Error{
        "headset URI \"" + source.headset +
        "\": it has a display of its own, for which there is orthonav run; a preview takes "
        "the headset of its cameras, the URI after the plus"};
  }
  std::unique_ptr<LiveOperation> live(
      new LiveOperation(std::move(*opened), gate, keyboard, timeline));
  if (const Status ready = live->prepare(source); !ready) {
    return ready.error();
  }
  return live;
}

LiveOperation::LiveOperation(OpenedHeadset opened, Gate& gate, Keyboard& keyboard,
                             Timeline& timeline)
    : headset_(std::move(opened.headset)),
      room_(opened.room),
      gate_(gate),
      gated_(*headset_, gate, keyboard),
      to_wearer_(gated_),
      timeline_(timeline) {}

LiveOperation::~LiveOperation() {
  if (operation_) {
    operation_->stop();
  }
  if (thread_.joinable()) {
    thread_.join();
  }
}

Status LiveOperation::prepare(const OperationSource& source) {
  const auto tools = source.tools_file.empty()
                         ? engine::tools_known_to(*headset_)
                         : engine::load_tools(source.tools_file, engine::ToolTags::kOptional);
  if (!tools) {
    return tools.error();
  }
  engine::AssemblyOptions options{.loop = loop_options()};
  options.session.replan.sizes = source.screw_sizes;
  options.use_reference = source.use_reference;
  if (source.reference_places) {
    options.reference_places = source.reference_places();
  }
  if (room_) {
    options.errors = engine::errors_in(room_->options());
    engine::tell_instruments(room_->options(), options.session);
    options.visibility.cross_and_depth =
        room_->options().guidance != sim::GuidanceProfile::kPublished;
  }
  auto assembled = engine::assemble_operation(gated_, source.operation, source.method,
                                              with_guide(*tools), options);
  if (!assembled) {
    return assembled.error();
  }
  operation_ = std::move(*assembled);
  operation_->observe(this);
  operation_->observe(&to_wearer_);
  operation_->draw_into(this);
  tell_end_ = source.ended;
  return source.assembled ? source.assembled(*operation_, room_) : Status{};
}

void LiveOperation::start() {
  thread_ = std::thread([this] { run(); });
}

void LiveOperation::run() {
  const engine::LoopReport report = operation_->run();
  outcome_ = report.ended;
  if (tell_end_) {
    tell_end_(report);
  }
  ended_ = true;
}

void LiveOperation::stepped(const FrameHeader& frame, const engine::Inputs& /*inputs*/,
                            const engine::Guidance& guidance) {
  moment_.tracking_ms = gated_.since_pair_ms();
  moment_.camera_ms = gated_.camera_ms();
  moment_.pair = gate_.passed();
  moment_.sequence = frame.sequence;
  moment_.time = frame.time;
  moment_.world_from_rig = headset_->head().world_from_rig(frame.time);
  if (room_) {
    moment_.room = room_->state();
  }
  moment_.tools.clear();
  const auto tools = operation_->session().tracker().tools();
  const auto states = operation_->session().tool_states();
  for (std::size_t i = 0; i < tools.size() && i < states.size(); ++i) {
    moment_.tools.push_back(seen(tools[i], states[i].world_from_marker));
  }
  moment_.detail = engine::detail_text(guidance.status);
}

/// Lays labels out for the surgeon's eye, or for the recording's left camera.
void LiveOperation::lay_out_labels(const engine::Snapshot& snapshot) {
  if (moment_.world_from_rig.status == PoseStatus::kLost) {
    return;
  }
  const StereoCamera* const cameras = headset_->cameras();
  const Vec3 left_m =
      cameras == nullptr ? Vec3{} : cameras->calibration().left_from_rig.inverse().translation();
  const auto rig_from_eye =
      room_ ? tools::rig_from_eye() : Transform<Rig, Eye>{Mat3::identity(), left_m};
  eye_.resize(1);
  eye_[0].eye_from_world =
      engine::to_matrix((moment_.world_from_rig.value * rig_from_eye).inverse().row_major());
  labels_.lay_out(moment_.scene, eye_, snapshot.patches, snapshot.display_time);
}

/// Comes after `stepped` for the same pair, or without one when guidance is taken back.
void LiveOperation::captured(const engine::Snapshot& snapshot) {
  moment_.at = snapshot.step;
  if (snapshot.blank) {
    moment_.detail = engine::text_of(engine::Message(engine::Ended{}));
  }
  moment_.scene = snapshot.scene;
  lay_out_labels(snapshot);
  timeline_.push(std::make_shared<const Moment>(moment_));
}

}  // namespace orthonav::preview
