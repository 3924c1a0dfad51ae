#include "engine/session/workflow.h"

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
    translatable("checked"),
    translatable("not shown"),
    translatable("not checked"),
    translatable("landmark touched"),
    translatable("landmark missing"),
    translatable("landmark moved"),
    translatable("bone unchecked"),
    translatable("wire settled"),
    translatable("wire undecided"),
    translatable("no change pending"),
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

constexpr std::array<std::string_view, kActionCount> kActionNames = {
    "refuse",
    "ignore",
    "explain",
    "begin level",
    "start sampling",
    "stop sampling",
    "save region",
    "drop region",
    "register",
    "show registration",
    "judge checks",
    "record check point",
    "drop check point",
    "accept",
    "clear level",
    "touch landmark",
    "drop landmark",
    "judge landmark",
    "expect landmark",
    "verify again",
    "correct guide",
    "select screw",
    "expect wire",
    "measure wire",
    "judge wire",
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
    "consent to change",
    "hide guidance",
    "show guidance",
    "forget map",
};

// A missing name at the end of an array would be empty.
static_assert(!kEventNames.back().empty() && !kActionNames.back().empty());

}  // namespace

std::string_view name_of(Event event) { return kEventNames[static_cast<std::size_t>(event)]; }
std::string_view name_of(Action action) { return kActionNames[static_cast<std::size_t>(action)]; }

}  // namespace orthonav::engine
