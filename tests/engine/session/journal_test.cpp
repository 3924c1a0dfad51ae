#include "engine/session/journal.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/session/journal_reader.h"
#include "tests/support/scripted_operation.h"
#include "tests/support/wait_until.h"

namespace orthonav::engine::journal_test {
namespace {

namespace fs = std::filesystem;

/// A HoloLens counts from the year 1601.
constexpr std::int64_t kEpoch = 116'444'736'000'000'000;

class JournalTest : public ::testing::Test {
 protected:
  JournalTest()
      : folder_(fs::path(::testing::TempDir()) /
                ::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    path_ = (folder_ / "session.orthonav").string();
  }
  ~JournalTest() override { fs::remove_all(folder_); }

  std::vector<nlohmann::json> lines() const {
    std::ifstream in(path_);
    std::vector<nlohmann::json> all;
    for (std::string line; std::getline(in, line);) {
      all.push_back(nlohmann::json::parse(line));
    }
    return all;
  }

  fs::path folder_;
  std::string path_;
};

TEST_F(JournalTest, TellsEveryChangeOfAScrewAndItsUndoing) {
  auto journal = Journal::create(path_, {"0.1.0", "fake", "paper", "boxes", 7, kEpoch}).value();
  test::ScriptedOperation s({"L4"});
  s.session().observe(journal.get());
  s.accepts_first_level();
  s.says("next");
  s.says("move cranial one");
  s.says("move cranial");
  s.says("move cranial ten");
  s.says("tilt lateral two");
  s.says("undo");
  ASSERT_TRUE(journal->finish().ok());
  std::vector<nlohmann::json> changes;
  for (const auto& line : lines()) {
    if (line.value("what", "") == "replanned") {
      changes.push_back(line);
    }
  }
  ASSERT_EQ(changes.size(), 3u) << "neither what was not understood nor what was refused";
  EXPECT_EQ(changes[0]["level"], "L4");
  EXPECT_EQ(changes[0]["side"], "left");
  EXPECT_EQ(changes[0]["asked"], "move cranial 1.0 mm");
  EXPECT_EQ(changes[0]["undone"], false);
  EXPECT_NEAR(changes[0]["from"]["entry_mm"][2].get<double>(), 0.0, 1e-9);
  EXPECT_NEAR(changes[0]["to"]["entry_mm"][2].get<double>(), 1.0, 1e-9);
  EXPECT_NEAR(changes[0]["to"]["target_mm"][2].get<double>(), 1.0, 1e-9);
  EXPECT_NEAR(changes[0]["to"]["diameter_mm"].get<double>(), 6.0, 1e-9);
  EXPECT_NEAR(changes[0]["planned_in_surgery"]["entry_cranial_mm"].get<double>(), 1.0, 1e-9);
  EXPECT_NEAR(changes[1]["planned_in_surgery"]["aim_medial_deg"].get<double>(), -2.0, 1e-9);
  EXPECT_EQ(changes[2]["asked"], "undo");
  EXPECT_EQ(changes[2]["undone"], true);
  EXPECT_EQ(changes[2]["to"], changes[0]["to"]);
  EXPECT_EQ(changes[2]["from"], changes[1]["to"]);
}

TEST_F(JournalTest, TellsWhoAskedFromOutsideBeforeWhatCameOfIt) {
  auto journal = Journal::create(path_, {"0.1.0", "fake", "paper", "boxes", 7, kEpoch}).value();
  test::ScriptedOperation s({"L4"});
  s.session().observe(journal.get());
  s.asks({"start", "10.0.0.7", {}, {}});
  ASSERT_TRUE(journal->finish().ok());
  const auto all = lines();
  ASSERT_GE(all.size(), 3u);
  EXPECT_EQ(all[1]["what"], "asked from outside");
  EXPECT_EQ(all[1]["from"], "10.0.0.7");
  EXPECT_EQ(all[1]["asked"], "start");
  EXPECT_EQ(all[2]["event"], "\"start\"");
  EXPECT_TRUE(read_journal(path_).ok()) << "and a report reads it";
}

TEST_F(JournalTest, TellsTheWholeOperation) {
  auto journal = Journal::create(path_, {"0.1.0", "fake", "paper", "boxes", 7, kEpoch}).value();
  test::ScriptedOperation s;
  s.session().observe(journal.get());
  s.tracker().guide = test::guide_at({0.015, 0.020, 0.0}, 0.1);
  s.finishes_every_screw();
  s.touches({0.02, 0.03, 0.00});
  s.touches({0.02, 0.03, 0.04});
  s.says("mumble");
  s.says("done");
  s.says("done");
  EXPECT_FALSE(fs::exists(path_)) << "named only when it is whole";
  ASSERT_TRUE(journal->finish().ok());

  const auto all = lines();
  ASSERT_FALSE(all.empty());
  EXPECT_EQ(all[0]["format"], "orthonav session");
  EXPECT_EQ(all[0]["seed"], 7);
  std::map<std::string, int> count;
  for (std::size_t i = 1; i < all.size(); ++i) {
    ++count[all[i]["what"]];
  }
  EXPECT_EQ(count["registration"], 2);
  EXPECT_EQ(count["screw"], 4);
  EXPECT_EQ(count["head"], 2);
  EXPECT_EQ(count["rod"], 2);
  EXPECT_EQ(count["not understood"], 1);
  for (std::size_t i = 1; i < all.size(); ++i) {
    EXPECT_EQ(all[i]["time_100ns"].get<std::int64_t>(),
              kEpoch + all[i]["time_ns"].get<std::int64_t>() / 100)
        << i;
  }
  for (std::size_t i = 2; i < all.size(); ++i) {
    EXPECT_GE(all[i]["time_100ns"], all[i - 1]["time_100ns"]) << i;
  }
  for (const auto& line : all) {
    if (line.value("what", "") == "screw" && line["side"] == "left") {
      EXPECT_NEAR(line["angle_deg"].get<double>(), 5.7296, 1e-3);
    }
  }
}

TEST_F(JournalTest, GrowsInTheOpenLineByLine) {
  auto journal = Journal::create(path_, {}).value();
  test::ScriptedOperation s({"L5"});
  s.session().observe(journal.get());
  s.says("start");
  const auto lines_so_far = [this] {
    std::ifstream in(path_ + ".part");
    int count = 0;
    for (std::string line; std::getline(in, line); ++count) {
      EXPECT_TRUE(nlohmann::json::accept(line)) << line;
    }
    return count;
  };
  EXPECT_TRUE(test::wait_until([&] { return lines_so_far() == 2; })) << "the header and the word";
  journal.reset();
  EXPECT_FALSE(fs::exists(path_)) << "nothing under its name without finish";
  EXPECT_EQ(lines_so_far(), 2) << "what was written stays";
}

TEST_F(JournalTest, SaysWhatEndedTheSessionBeforeItsTime) {
  auto journal = Journal::create(path_, {}).value();
  test::ScriptedOperation s({"L5"});
  s.session().observe(journal.get());
  s.says("start");
  ASSERT_TRUE(journal->finish({Timestamp(std::chrono::seconds(900)), "cable"}).ok());
  const auto all = lines();
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[2]["what"], "ended");
  EXPECT_EQ(all[2]["reason"], "cable");
  EXPECT_EQ(all[2]["time_ns"], 900'000'000'000) << "that of the last pair, not of the last word";
}

TEST_F(JournalTest, GivesNoNumbersOfARegistrationThatThereIsNot) {
  auto journal = Journal::create(path_, {}).value();
  test::ScriptedOperation s({"L5"});
  s.session().observe(journal.get());
  s.unusable = "0 points, at least 100 needed";
  s.says("start");
  s.does({ClickerAction::kDoubleClick});
  s.unusable.reset();
  s.does({ClickerAction::kDoubleClick});
  ASSERT_TRUE(journal->finish().ok());
  std::vector<nlohmann::json> registrations;
  for (const auto& line : lines()) {
    if (line.value("what", "") == "registration") {
      registrations.push_back(line);
    }
  }
  ASSERT_EQ(registrations.size(), 2u);
  EXPECT_EQ(registrations[0]["reason"], "0 points, at least 100 needed");
  for (const char* key : {"points", "rmse_mm", "world_from_vertebra_mm", "predicted_tre_mm"}) {
    EXPECT_FALSE(registrations[0].contains(key)) << key;
    EXPECT_TRUE(registrations[1].contains(key)) << key;
  }
}

TEST_F(JournalTest, TellsWhatBestSaysOfARegistrationAndThePlacesTouchedToCheckIt) {
  auto journal = Journal::create(path_, {}).value();
  test::ScriptedOperation s({"L5"}, {}, Verification::kByTouch);
  s.session().observe(journal.get());
  s.tracker().size = nav::TagSize{-0.032, 0.001, 12, true, true};
  s.registration.noise_m = 0.0007;
  s.registration.inlier_fraction = 0.97;
  s.registration.effective_points = 120.0;
  s.registration.log_likelihood_ratio = std::numeric_limits<double>::infinity();
  s.registration.coverage_fraction = 0.6;
  s.registration.predicted_tre_m = 0.0008;
  s.registration.tre_95_m = 0.0014;
  s.registration.weakest = {nav::UncertainMotion::Kind::kFlexion, 0.0012};
  s.registration.stroke_next = {nav::BonePlace::Part::kLamina, Side::kLeft,
                                nav::BonePlace::Height::kUpper};
  s.registration.fits_better = "L4";
  s.registers_first_level();
  s.touches({0.0, 0.0213, 0.0});
  s.touches({0.02, 0.0251, 0.0});
  s.says("delete");
  ASSERT_TRUE(journal->finish().ok());
  std::map<std::string, std::vector<nlohmann::json>> by_what;
  for (const auto& line : lines()) {
    if (line.contains("what")) {
      by_what[line["what"]].push_back(line);
    }
  }
  ASSERT_EQ(by_what["registration"].size(), 1u);
  const auto& line = by_what["registration"][0];
  EXPECT_DOUBLE_EQ(line["noise_mm"], 0.7);
  EXPECT_DOUBLE_EQ(line["inlier_share"], 0.97);
  EXPECT_DOUBLE_EQ(line["effective_points"], 120.0);
  EXPECT_TRUE(line["margin"].is_null()) << "no rival at all";
  EXPECT_DOUBLE_EQ(line["coverage_share"], 0.6);
  EXPECT_DOUBLE_EQ(line["expected_tre_mm"], 0.8);
  EXPECT_DOUBLE_EQ(line["tre_95_mm"], 1.4);
  EXPECT_EQ(line["weakest"], "flexion/extension (1.2 mm at the screws)");
  EXPECT_EQ(line["advice"], "digitize the left upper lamina");
  EXPECT_EQ(line["fits_better"], "L4");
  EXPECT_EQ(line["warning"], "pointer: tag 3.2 % smaller than stated, check print and unit");
  ASSERT_EQ(by_what["check point"].size(), 2u);
  EXPECT_NEAR(by_what["check point"][0]["distance_mm"].get<double>(), 1.3, 1e-6);
  EXPECT_EQ(by_what["check point"][0]["within"], true);
  EXPECT_EQ(by_what["check point"][1]["number"], 2);
  EXPECT_EQ(by_what["check point"][1]["within"], false);
  EXPECT_NEAR(by_what["check point"][1]["in_world_mm"][1].get<double>(), 25.1, 1e-6);
  ASSERT_EQ(by_what["check point dropped"].size(), 1u);
  EXPECT_EQ(by_what["check point dropped"][0]["number"], 2);
}

TEST_F(JournalTest, SaysNothingOfBestWhereItWasNotAsked) {
  auto journal = Journal::create(path_, {}).value();
  test::ScriptedOperation s({"L5"});
  s.session().observe(journal.get());
  s.registers_first_level();
  ASSERT_TRUE(journal->finish().ok());
  for (const auto& line : lines()) {
    if (line.value("what", "") != "registration") {
      continue;
    }
    for (const char* key : {"noise_mm", "margin", "weakest", "advice", "warning", "tre_95_mm"}) {
      EXPECT_FALSE(line.contains(key)) << key;
    }
  }
}

TEST_F(JournalTest, RefusesAFolderThatIsNotThere) {
  const auto journal = Journal::create((folder_ / "no" / "such.orthonav").string(), {});
  EXPECT_FALSE(journal.ok());
}

}  // namespace
}  // namespace orthonav::engine::journal_test
