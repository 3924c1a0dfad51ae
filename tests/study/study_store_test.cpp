#include "study/study_store.h"

#include <gmock/gmock.h>

#include <sqlite3.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>

#include "engine/case/tool_file.h"
#include "engine/phantom/phantom.h"
#include "study/study_profile.h"
#include "study/study_text.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::engine {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::StartsWith;

/// A folder of its own for each test.
class StudyStoreTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::string file(const std::string& name) const { return folder_.file(name); }
  /// Runs each shard of a study into a file of its own.
  void make_shards(const Case& spine, const StudyOptions& whole, int shards,
                   std::vector<std::string>& files) const {
    for (int shard = 1; shard <= shards; ++shard) {
      StudyOptions part = whole;
      part.shards = shards;
      part.shard = shard;
      part.store = file("shard" + std::to_string(shard) + ".db");
      files.push_back(part.store);
      ASSERT_TRUE(run_study({&spine, 1}, part).ok());
    }
  }
  const test::TemporaryFolder folder_;
};

StudyOptions short_runs() {
  StudyOptions options;
  options.runs = 4;
  options.operation.levels = {"L5"};
  options.operation.tools = built_in_tools();
  options.operation.measurement = Measurement::kModel;
  options.operation.loop.draw_every = 0;
  options.operation.loop.max_frames = 2;
  options.version = "test";
  return options;
}

std::vector<StoredOperation> operations_of(const StudyStore& store) {
  std::vector<StoredOperation> out;
  const Status all = store.for_each([&out](const StoredOperation& operation) {
    out.push_back(operation);
    return Status();
  });
  EXPECT_TRUE(all.ok()) << all.error().message;
  return out;
}

Result<std::string> merge_stores(std::span<const std::string> files) {
  const auto store = StudyStore::joined(files);
  return store ? study_text(*store) : Result<std::string>(store.error());
}

TEST_F(StudyStoreTest, KeepsWhatWasAddedThoughItWasNeverFinished) {
  {
    auto store = StudyStore::open(file("a.db"), "{}");
    ASSERT_TRUE(store.ok()) << store.error().message;
    ASSERT_TRUE(store->add({3, "phantom", 18446744073709551615u, "{\"a\":1}", ""}).ok());
    ASSERT_TRUE(store->add({1, "phantom", 7, "", "no room"}).ok());
  }
  EXPECT_FALSE(fs::exists(file("a.db")));
  auto again = StudyStore::open(file("a.db"), "{}");
  ASSERT_TRUE(again.ok()) << again.error().message;
  const auto operations = operations_of(*again);
  ASSERT_THAT(operations, SizeIs(2));
  EXPECT_EQ(operations[0].why, "no room");
  EXPECT_EQ(operations[1].seed, 18446744073709551615u);
  ASSERT_TRUE(again->finish().ok());
  EXPECT_TRUE(fs::exists(file("a.db")));
  EXPECT_FALSE(fs::exists(file("a.db.part")));
}

TEST_F(StudyStoreTest, TakesAnOperationThatRanTwiceOnce) {
  auto store = StudyStore::open(file("a.db"), "{}");
  ASSERT_TRUE(store.ok());
  ASSERT_TRUE(store->add({0, "phantom", 1, "{\"first\":1}", ""}).ok());
  ASSERT_TRUE(store->add({0, "phantom", 1, "{\"second\":1}", ""}).ok());
  const auto operations = operations_of(*store);
  ASSERT_THAT(operations, SizeIs(1));
  EXPECT_EQ(operations.front().report, "{\"first\":1}");
}

TEST_F(StudyStoreTest, RefusesAnotherStudyAndWhatIsNone) {
  ASSERT_TRUE(StudyStore::open(file("a.db"), "{\"a\":1}")->finish().ok());
  const auto other = StudyStore::open(file("a.db"), "{\"a\":2}");
  ASSERT_FALSE(other.ok());
  EXPECT_THAT(other.error().message, HasSubstr("holds study " + study_hash("{\"a\":1}")));
  const std::string text =
      folder_.with("text.db", "no database at all, but long enough to be looked at");
  const std::string absent = file("absent.db");
  for (const std::vector<std::string>& files :
       {std::vector{text}, {absent}, {file("a.db"), text}, {file("a.db"), absent}}) {
    const auto joined = StudyStore::joined(files);
    ASSERT_FALSE(joined.ok());
    EXPECT_THAT(joined.error().message, StartsWith(files.back() + ": "));
  }
  EXPECT_FALSE(fs::exists(absent)) << "what is read is not made";
}

TEST_F(StudyStoreTest, RefusesAFileWhoseDefinitionWasChanged) {
  ASSERT_TRUE(StudyStore::open(file("a.db"), "{\"runs\":12345}")->finish().ok());
  std::string bytes = test::content_of(file("a.db"));
  bytes.replace(bytes.find("12345"), 5, "54321");
  const std::vector<std::string> files = {folder_.with("a.db", bytes)};
  const auto read = StudyStore::joined(files);
  ASSERT_FALSE(read.ok());
  EXPECT_THAT(read.error().message, HasSubstr("does not belong to its hash"));
}

// A journal beside the file takes back what its worker had begun.
TEST_F(StudyStoreTest, JoinsAShardWhoseWorkerDiedWhileItWrote) {
  {
    auto store = StudyStore::open(file("a.db"), "{}");
    ASSERT_TRUE(
        store->add({0, "phantom", 1, "{\"a\":\"" + std::string(800, 'x') + "\"}", ""}).ok());
    ASSERT_TRUE(store->finish().ok());
  }
  sqlite3* worker = nullptr;
  ASSERT_EQ(sqlite3_open(file("a.db").c_str(), &worker), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(worker,
                         "PRAGMA cache_size = 2; BEGIN;"
                         "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n LIMIT 99)"
                         "INSERT INTO operation SELECT study, i, case_name, seed, report, why "
                         "FROM operation, n;",
                         nullptr, nullptr, nullptr),
            SQLITE_OK);
  fs::copy_file(file("a.db"), file("b.db"));
  fs::copy_file(file("a.db-journal"), file("b.db-journal"));
  EXPECT_GT(fs::file_size(file("b.db")), 50'000u) << "control: the file holds what was begun";
  sqlite3_close(worker);
  const std::vector<std::string> files = {file("b.db")};
  const auto joined = StudyStore::joined(files);
  ASSERT_TRUE(joined.ok()) << joined.error().message;
  EXPECT_THAT(operations_of(*joined), SizeIs(1));
}

TEST_F(StudyStoreTest, RefusesAnOperationWithTwoResults) {
  for (const std::string name : {"a", "b"}) {
    auto store = StudyStore::open(file(name + ".db"), "{}");
    ASSERT_TRUE(store->add({0, "phantom", 1, "{}", ""}).ok());
    ASSERT_TRUE(store->add({7, "phantom", 8, "{\"of\":\"" + name + "\"}", ""}).ok());
    ASSERT_TRUE(store->finish().ok());
  }
  const std::vector<std::string> files = {file("a.db"), file("b.db")};
  const auto joined = StudyStore::joined(files);
  ASSERT_FALSE(joined.ok());
  EXPECT_EQ(joined.error().message,
            files[1] + ": operation 7 has another result than in the other files");
  const std::vector<std::string> twice = {files[0], files[0]};
  EXPECT_TRUE(StudyStore::joined(twice).ok());
}

TEST_F(StudyStoreTest, ShardsJoinToTheBytesOfOneProcess) {
  const Case spine = phantom({"L5"});
  const auto whole = run_study({&spine, 1}, short_runs());
  ASSERT_TRUE(whole.ok()) << whole.error().message;
  std::vector<std::string> files;
  ASSERT_NO_FATAL_FAILURE(make_shards(spine, short_runs(), 3, files));
  const auto joined = merge_stores(files);
  ASSERT_TRUE(joined.ok()) << joined.error().message;
  EXPECT_EQ(*joined, whole->text);

  const std::vector<std::string> two = {files[0], files[2]};
  const auto without = merge_stores(two);
  ASSERT_TRUE(without.ok()) << without.error().message;
  EXPECT_THAT(*without, HasSubstr("\"incomplete\": true,\n \"planned\": 4"));
  EXPECT_THAT(*without, Not(HasSubstr("\"seed\": 2")));

  StudyOptions other = short_runs();
  other.first_seed = 5;
  other.store = file("other.db");
  ASSERT_TRUE(run_study({&spine, 1}, other).ok());
  const std::vector<std::string> mixed = {files[0], other.store};
  EXPECT_THAT(merge_stores(mixed).error().message, HasSubstr("other.db: holds study"));
}

TEST_F(StudyStoreTest, ShardsOfStatedNavigationJoinToTheBytesOfOneProcess) {
  const Case spine = phantom({"L5"});
  StudyOptions options = short_runs();
  options.runs = 2;
  const auto profile = parse_profile(R"({"name": "stated", "guidance": "closed loop",
    "instrument": "cannula", "navigation": {"target_mm": 0.8, "angle_deg": 0.5}})",
                                     "file");
  ASSERT_TRUE(profile.ok()) << profile.error().message;
  profile->apply(options.operation);
  const auto whole = run_study({&spine, 1}, options);
  ASSERT_TRUE(whole.ok()) << whole.error().message;
  EXPECT_THAT(whole->text, HasSubstr("\"method\": \"stated\""));
  std::vector<std::string> files;
  ASSERT_NO_FATAL_FAILURE(make_shards(spine, options, 2, files));
  const auto joined = merge_stores(files);
  ASSERT_TRUE(joined.ok()) << joined.error().message;
  EXPECT_EQ(*joined, whole->text);
}

TEST_F(StudyStoreTest, AShardTakesWhatIsItsOwnFromAWholeStudy) {
  const Case spine = phantom({"L5"});
  StudyOptions options = short_runs();
  options.store = file("a.db");
  const auto whole = run_study({&spine, 1}, options);
  ASSERT_TRUE(whole.ok()) << whole.error().message;
  options.shards = 2;
  options.shard = 2;
  int made = 0;
  const auto part = run_study({&spine, 1}, options, [&made](int, int) { ++made; });
  ASSERT_TRUE(part.ok()) << part.error().message;
  EXPECT_EQ(made, 0);
  EXPECT_EQ(part->made, 2);
  EXPECT_THAT(part->text, HasSubstr("\"seed\": 4"));
  EXPECT_THAT(part->text, Not(HasSubstr("\"seed\": 3")));
}

TEST_F(StudyStoreTest, DoesNotMakeAgainWhatItHolds) {
  const Case spine = phantom({"L5"});
  StudyOptions options = short_runs();
  options.store = file("a.db");
  const auto first = run_study({&spine, 1}, options);
  ASSERT_TRUE(first.ok()) << first.error().message;
  int made = 0;
  const auto second = run_study({&spine, 1}, options, [&made](int, int) { ++made; });
  ASSERT_TRUE(second.ok()) << second.error().message;
  EXPECT_EQ(made, 0);
  EXPECT_EQ(second->text, first->text);
}

TEST_F(StudyStoreTest, ADatabaseThatIsDamagedIsNamedInOneLine) {
  {
    auto store = StudyStore::open(file("a.db"), "{}");
    ASSERT_TRUE(store.ok());
    for (int number = 0; number < 40; ++number) {
      ASSERT_TRUE(
          store->add({number, "phantom", 1, "{\"a\":\"" + std::string(800, 'x') + "\"}", ""}).ok());
    }
    ASSERT_TRUE(store->finish().ok());
  }
  std::string bytes = test::content_of(file("a.db"));
  bytes.replace(3 * 4096, bytes.size() - 3 * 4096, bytes.size() - 3 * 4096, '\xee');
  const std::vector<std::string> files = {folder_.with("a.db", bytes)};
  const auto joined = merge_stores(files);
  ASSERT_FALSE(joined.ok());
  EXPECT_THAT(joined.error().message, HasSubstr("a.db: "));
  EXPECT_THAT(joined.error().message, Not(HasSubstr("\n")));
}

/// While it exists, only this many files may be open.
class FewOpenFiles {
 public:
  explicit FewOpenFiles(rlim_t most) {
    getrlimit(RLIMIT_NOFILE, &limit_);
    const rlimit few{most, limit_.rlim_max};
    setrlimit(RLIMIT_NOFILE, &few);
  }
  FewOpenFiles(const FewOpenFiles&) = delete;
  FewOpenFiles& operator=(const FewOpenFiles&) = delete;
  ~FewOpenFiles() { setrlimit(RLIMIT_NOFILE, &limit_); }

 private:
  rlimit limit_{};
};

TEST_F(StudyStoreTest, JoinsMoreFilesThanMayBeOpen) {
  const Case spine = phantom({"L5"});
  std::vector<std::string> files;
  ASSERT_NO_FATAL_FAILURE(make_shards(spine, short_runs(), 2, files));
  const auto joined = merge_stores(files);
  ASSERT_TRUE(joined.ok()) << joined.error().message;
  constexpr int kFiles = 300;
  for (int i = 2; i < kFiles; ++i) {
    files.push_back(file("copy" + std::to_string(i) + ".db"));
    fs::copy_file(files[static_cast<std::size_t>(i % 2)], files.back());
  }
  const FewOpenFiles few(200);
  const auto of_all = merge_stores(files);
  ASSERT_TRUE(of_all.ok()) << of_all.error().message;
  EXPECT_EQ(*of_all, *joined);
}

/// While it exists, no file may grow beyond this size, as on a full disk.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : before_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &limit_);
    const rlimit small{bytes, limit_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &limit_);
    std::signal(SIGXFSZ, before_);
  }

 private:
  rlimit limit_{};
  void (*before_)(int);
};

TEST_F(StudyStoreTest, OnAFullDiskAStudyEndsInOneLineAndKeepsWhatItHas) {
  const Case spine = phantom({"L5"});
  StudyOptions options = short_runs();
  options.runs = 30;
  options.store = file("a.db");
  {
    const FullDisk disk(48 * 1024);
    const auto study = run_study({&spine, 1}, options);
    ASSERT_FALSE(study.ok()) << "30 operations do not fit";
    EXPECT_THAT(study.error().message, HasSubstr("a.db: "));
    EXPECT_THAT(study.error().message, Not(HasSubstr("\n")));
  }
  EXPECT_FALSE(fs::exists(file("a.db")));
  const std::vector<std::string> files = {file("a.db.part")};
  const auto kept = StudyStore::joined(files);
  ASSERT_TRUE(kept.ok()) << kept.error().message;
  EXPECT_LT(operations_of(*kept).size(), 30u);
  EXPECT_GT(operations_of(*kept).size(), 0u);
  const auto rest = run_study({&spine, 1}, options);
  ASSERT_TRUE(rest.ok()) << rest.error().message;
  EXPECT_EQ(rest->made, 30);
}

}  // namespace
}  // namespace orthonav::engine
