#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "tests/hal/openxr/runtime_test.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// What the validation layer names each of its findings by.
constexpr const char* kMisuse = "VUID-";

struct Ran {
  int code = -1;
  std::string out;     ///< and what it said beside
  std::string report;  ///< of the runtime
};

/// `orthonav` with these arguments on a runtime that follows a script, with the core validation
/// layer writing to the output unless it is left out.
Ran run(const std::string& arguments, const std::string& script, bool validated = true) {
  const TemporaryFolder folder;
  const std::string base = folder.path().string();
  std::ofstream(base + "/script") << "report " << base << "/report\nreal_time\n" << script;
  const std::string command =
      "XR_RUNTIME_JSON=" ORTHONAV_XR_MANIFEST " ORTHONAV_XR_SCRIPT=" + base + "/script " +
      (validated ? "XR_ENABLE_API_LAYERS=XR_APILAYER_LUNARG_core_validation "
                   "XR_CORE_VALIDATION_EXPORT_TYPE=text "
                 : "") +
      "'" ORTHONAV_COMMAND "' " + arguments + " >" + base + "/out 2>&1";
  Ran ran;
  const int status = std::system(command.c_str());
  ran.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  ran.out = content_of(base + "/out");
  ran.report = content_of(base + "/report");
  return ran;
}

/// A control that must fail: the layer does report when it finds something.
TEST(RunOnOpenxr, WouldHearTheValidationLayer) {
  runtime_double().reset({});
  ::setenv("XR_ENABLE_API_LAYERS", "XR_APILAYER_LUNARG_core_validation", 1);
  ::setenv("XR_CORE_VALIDATION_EXPORT_TYPE", "text", 1);
  ::testing::internal::CaptureStdout();
  XrInstanceCreateInfo info = {XR_TYPE_INSTANCE_CREATE_INFO};
  std::snprintf(info.applicationInfo.applicationName, XR_MAX_APPLICATION_NAME_SIZE, "misuse");
  info.applicationInfo.apiVersion = XR_CURRENT_API_VERSION;
  XrInstance instance = XR_NULL_HANDLE;
  ASSERT_EQ(xrCreateInstance(&info, &instance), XR_SUCCESS);
  XrSystemGetInfo get = {XR_TYPE_UNKNOWN};
  XrSystemId system = XR_NULL_SYSTEM_ID;
  static_cast<void>(xrGetSystem(instance, &get, &system));
  xrDestroyInstance(instance);
  ::unsetenv("XR_ENABLE_API_LAYERS");
  EXPECT_THAT(::testing::internal::GetCapturedStdout(), HasSubstr(kMisuse));
}

constexpr const char* kQuick = "run --headset openxr:+sim: --levels L5 --frames 120 --stats";

TEST(RunOnOpenxr, ShowsAnOperationWithoutAWordOfTheValidationLayer) {
  const Ran ran = run(kQuick, "period_ms 10\n");
  EXPECT_EQ(ran.code, 0) << ran.out;
  EXPECT_THAT(ran.out, AllOf(HasSubstr("Core Validation output type"), HasSubstr("head pose to"),
                             Not(HasSubstr(kMisuse))));
  EXPECT_THAT(ran.report, AllOf(HasSubstr("sessions 1\n"), Not(HasSubstr("violation")),
                                Not(HasSubstr("lit 0\n"))));
}

TEST(RunOnOpenxr, SurvivesTheLossOfTheRuntimeWithOneLine) {
  const Ran ran = run(kQuick, "period_ms 10\nlose_instance_at 20\n", false);
  EXPECT_EQ(ran.code, 0) << ran.out;
  const std::size_t first = ran.out.find("XR_ERROR_INSTANCE_LOST");
  ASSERT_NE(first, std::string::npos) << ran.out;
  EXPECT_EQ(ran.out.find("XR_ERROR_INSTANCE_LOST", first + 1), std::string::npos) << ran.out;
  EXPECT_THAT(ran.report, AllOf(HasSubstr("instances 2\n"), Not(HasSubstr("violation"))));
}

TEST(RunOnOpenxr, EndsWhenTheUserEndsTheSession) {
  const Ran ran = run("run --headset openxr:+sim: --levels L5", "period_ms 10\nend_at 40\n", false);
  EXPECT_EQ(ran.code, 1) << "not completed: " << ran.out;
  EXPECT_THAT(ran.out, HasSubstr("ended from outside"));
  EXPECT_THAT(ran.report, Not(HasSubstr("violation")));
}

TEST(RunOnOpenxr, SaysInOneLineThatThereIsNoRuntime) {
  const TemporaryFolder folder;
  const std::string out = folder.path().string() + "/out";
  const int status = std::system(("XR_RUNTIME_JSON=/nowhere.json '" ORTHONAV_COMMAND
                                  "' run --headset openxr:+sim: >" +
                                  out + " 2>&1")
                                     .c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
  const std::string told = content_of(out);
  EXPECT_THAT(told, AllOf(HasSubstr("openxr: no runtime answers"), HasSubstr("XR_RUNTIME_JSON")));
  EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 1) << told;
}

TEST(Doctor, NamesTheRuntimeThatAnswers) {
  const Ran ran = run("doctor", "", false);
  EXPECT_THAT(ran.out, HasSubstr("orthonav's double 0.1.0, scripted headset"));
}

}  // namespace
}  // namespace orthonav::test
