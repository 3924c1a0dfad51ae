#include "engine/session/workflow/workflow.h"

#include "base/translation.h"

namespace orthonav::engine {

namespace {

// Spoken words are not translated.
constexpr std::array<std::string_view, kEventCount> kEventNames = {
    translatable("press"),
    translatable("release"),
    translatable("click"),
    translatable("double click"),
    translatable("hold"),
    "\"start\"",
    "\"save\"",
    "\"delete\"",
    "\"accept\"",
    "\"reject\"",
    "\"next\"",
    "\"done\"",
    "\"move rod\"",
    "\"twin\"",
    "\"numbers\"",
    "\"drill\"",
    translatable("change of the screw"),
    translatable("registered"),
    translatable("registration refused"),
    translatable("registration restored"),
    translatable("acceptance restored"),
    translatable("landmark moved"),
    translatable("bone unchecked"),
    translatable("screw redone"),
    translatable("no other entry"),
    translatable("another screw"),
    translatable("another level"),
    translatable("no screw left"),
    translatable("no rod planned"),
    translatable("another side"),
    translatable("no side left"),
    translatable("tracking lost"),
    translatable("pose stale"),
    translatable("tracking regained"),
    translatable("map moved"),
    translatable("reference hidden"),
    translatable("reference seen"),
    translatable("reference moved"),
};

constexpr std::array<std::string_view, kStateCount> kStateNames = {
    "breach pending",     "not shown",        "checks passed",
    "correction offered", "landmark touched", "wire beyond limit",
};

constexpr std::array<std::string_view, kActionCount> kActionNames = {
    "refuse",
    "ignore",
    "explain not shown",
    "explain checks",
    "explain landmark",
    "explain wire",
    "explain no other entry",
    "begin level",
    "start sampling",
    "stop sampling",
    "save region",
    "drop region",
    "register",
    "show registration",
    "record check point",
    "drop check point",
    "accept",
    "clear level",
    "record landmark",
    "drop landmark",
    "expect landmark",
    "verify again",
    "correct guide",
    "select screw",
    "expect wire",
    "record wire",
    "keep wire",
    "judge redo",
    "finish screw",
    "begin rod",
    "begin touch",
    "end touch",
    "drop touch",
    "record head",
    "drop head",
    "finish rod",
    "move rod",
    "show or hide twin",
    "show or hide numbers",
    "watch drill",
    "change screw",
    "take breach",
    "hide guidance",
    "show guidance",
    "forget map",
};

// A missing name at the end of an array would be empty.
static_assert(!kEventNames.back().empty() && !kStateNames.back().empty() &&
              !kActionNames.back().empty());

}  // namespace

std::string_view name_of(State state) { return kStateNames[static_cast<std::size_t>(state)]; }
std::string_view name_of(Event event) { return kEventNames[static_cast<std::size_t>(event)]; }
std::string_view name_of(Action action) { return kActionNames[static_cast<std::size_t>(action)]; }

}  // namespace orthonav::engine
