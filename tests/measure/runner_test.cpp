#include "harness/measure/runner.hpp"

#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <limits>
#include <random>
#include <thread>

#include "harness/error.hpp"
#include "harness/measure/interrupt.hpp"
#include "tests/support/fake.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

using namespace test;

MakeSubject fakes() {
  return [](const Case&) { return std::make_unique<FakeSubject>(10.0); };
}

const SamplingLimits kShort{0, 6, 10, 0.5, 1};

/// Runs a case whose subject is a FakeSubject of this type, made from the arguments.
template <class Fake, class... Arguments>
Row row_of(Arguments... arguments) {
  const RunPlan plan = fake_plan(1);
  return run_case(plan, plan.cases[0], kShort,
                  [=](const Case&) { return std::make_unique<Fake>(arguments...); });
}

struct Runner : InFolder {
  Journal journal{folder.path / "j.jsonl", Journal::Mode::fresh};
};

TEST_F(Runner, AnOkRowHoldsItsSamplesAndSaysWhereItComesFrom) {
  RunPlan plan = fake_plan(1);
  plan.provenance["host"] = "h";
  const Row row = run_case(plan, plan.cases[0], kShort, fakes());
  EXPECT_EQ(row.status, Status::ok) << row.reason;
  EXPECT_EQ(row.samples.at("frame").wall_ms.size(), 6u);
  EXPECT_EQ(row.provenance.at("host"), "h");
  EXPECT_TRUE(row.provenance.contains("utc"));
  EXPECT_GE(row.provenance.value("load", -1.0), 0);
  EXPECT_TRUE(row.provenance.contains("load_after"));
  EXPECT_EQ(row.image_hash.size(), 16u);
  EXPECT_EQ(row.repeat, 0);
}

/// A subject whose frames take at least `ms`.
struct Slow : FakeSubject {
  explicit Slow(int ms) : FakeSubject(10), ms_(ms) {}
  FrameSample frame() override {
    std::this_thread::sleep_for(std::chrono::milliseconds(ms_));
    return FakeSubject::frame();
  }
  int ms_;
};

TEST_F(Runner, ARowSaysWhatOtherProcessesTook) {
  const Row row = row_of<Slow>(100);
  ASSERT_EQ(row.status, Status::ok) << row.reason;
  if (!std::ifstream("/proc/stat")) GTEST_SKIP() << "no /proc/stat";
  ASSERT_TRUE(row.provenance.contains("other_cpu_share"));
  EXPECT_NEAR(row.provenance.at("other_cpu_share").get<double>(), 0.5, 0.5);
}

struct Compared : FakeSubject {
  Compared() : FakeSubject(10.0, 59.9) {}
  void describe(Row& row) override {
    row.metrics = {{"opengl_ratio", {12, "times"}}, {"covered_fragments", {5e6, "fragments"}}};
  }
};

TEST_F(Runner, AFailedCheckPublishesNoTimeAndNoRatioOfTimes) {
  const Row row = row_of<Compared>();
  EXPECT_EQ(row.status, Status::failed_check);
  EXPECT_TRUE(row.samples.empty());
  EXPECT_TRUE(row.metrics.size() == 1 && row.metrics.contains("covered_fragments"));
  test::expect_has(row.reason, "psnr against reference is 59.9, but must be at least 60");
}

struct Unchecked : FakeSubject {
  Unchecked() : FakeSubject(10) {}
  std::vector<Check> check(const Picture&) override { return {}; }
};

struct Diverging : FakeSubject {
  Diverging() : FakeSubject(10) {}
  Picture read() override { return {1, 1, {glm::vec4(std::numeric_limits<float>::quiet_NaN(), 0, 0, 1)}}; }
};

TEST_F(Runner, NothingCheckedIsNotOk) {
  EXPECT_EQ(row_of<Unchecked>().status, Status::failed_check);
  EXPECT_EQ(row_of<Diverging>().status, Status::diverged);
}

/// Every comparison with NaN is false, so a check whose value is NaN must fail.
TEST_F(Runner, ACheckThatIsNotANumberFails) {
  EXPECT_EQ(row_of<FakeSubject>(10.0, std::nan("")).status, Status::failed_check);
}

TEST_F(Runner, ACaseMustMeetWhatItsExperimentRequires) {
  RunPlan plan = fake_plan(1);
  for (const auto& [least, status] : {std::pair{12.0, Status::ok}, {12.5, Status::failed_check}}) {
    plan.cases[0].require = {{"triangles", least}};
    EXPECT_EQ(run_case(plan, plan.cases[0], kShort, fakes()).status, status) << least;
  }
  plan.cases[0].require = {{"never measured", 0}};
  EXPECT_EQ(run_case(plan, plan.cases[0], kShort, fakes()).status, Status::failed_check);
}

TEST_F(Runner, ADeviceFailureOrBadInputIsARowAndTheOthersGoOn) {
  const RunPlan plan = fake_plan(5);
  const RunSummary summary = run_cases(
      plan,
      [](const Case& c) -> std::unique_ptr<Subject> {
        if (c.name == "case1")
          throw DeviceError("clBuildProgram: CL_BUILD_PROGRAM_FAILURE\nlog line 1\nlog line 2");
        if (c.name == "case2") throw Unsupported("no fp64");
        if (c.name == "case3") throw InputError("cow.off: empty");
        return std::make_unique<FakeSubject>(10.0);
      },
      journal);
  EXPECT_EQ(summary.ok, 3u);
  EXPECT_EQ(summary.not_ok, 2u);
  const auto rows = read_contents(journal.file()).rows;
  ASSERT_EQ(rows.size(), 5u);
  EXPECT_EQ(rows[1].status, Status::error);
  test::expect_has(rows[1].reason, "log line 2");
  EXPECT_EQ(rows[1].build_ms + rows[1].first_launch_ms, 0);
  EXPECT_EQ(rows[2].status, Status::unsupported);
  EXPECT_EQ(rows[3].status, Status::error);
  EXPECT_EQ(rows[3].reason, "cow.off: empty");
  EXPECT_EQ(rows[4].status, Status::ok);
}

TEST_F(Runner, ASpentBudgetLeavesTheRest) {
  RunPlan plan = fake_plan(3);
  plan.budget_s = 0;
  EXPECT_EQ(run_cases(plan, fakes(), journal).left, 3u);
  plan.budget_s = 100;
  EXPECT_EQ(run_cases(plan, fakes(), journal).ok, 3u);
}

TEST_F(Runner, AfterACaseThatMayNotStartNoneStarts) {
  int asked = 0;
  const RunSummary summary =
      run_cases(fake_plan(3), fakes(), journal, {[&](const Case&) { return ++asked != 2; }, {}, {}});
  EXPECT_TRUE(summary.disturbed);
  EXPECT_EQ(asked, 2);
  EXPECT_EQ(summary.ok, 1u);
  EXPECT_EQ(summary.left, 2u);
}

// The reported times grow from frame to frame, so their median never reaches the required precision.
TEST_F(Runner, CasesThatNeverConvergeShareTheBudget) {
  RunPlan plan = fake_plan(4);
  plan.limits = {0, 1, 1000000, 0, 100};
  plan.budget_s = 2.4;
  const auto from = std::chrono::steady_clock::now();
  const RunSummary summary = run_cases(
      plan, [](const Case&) { return std::make_unique<Slow>(1); }, journal);
  EXPECT_EQ(summary.ok, 4u);
  EXPECT_EQ(summary.left, 0u) << "the first case took the budget of the others";
  EXPECT_GE(std::chrono::steady_clock::now() - from, std::chrono::milliseconds(2400)) << "time was left over";
}

struct Covering : FakeSubject {
  Covering() : FakeSubject(10) {}
  void describe(Row& row) override { row.metrics["covered_fragments"] = {5e6, "fragments"}; }
};

TEST_F(Runner, FragmentsPerSecondAreFragmentsOverTheMedianFrame) {
  const Row row = row_of<Covering>();
  ASSERT_TRUE(row.metrics.contains("fragments_per_s")) << row.reason;
  EXPECT_NEAR(row.metrics.at("fragments_per_s").value, 5e6 / 10.0055e-3, 1e3);  // 10.003 to 10.008 ms
  EXPECT_EQ(row.metrics.at("fragments_per_s").unit, "1/s");
}

/// Runs fake cases in a child process. After `kill_after_ms` milliseconds, sends the signal `signal_number`
/// to the child. Sends no signal if `kill_after_ms` is negative. Returns the wait status of the child.
int run_in_child(const fs::path& file, int cases, double kill_after_ms, int signal_number) {
  const pid_t child = fork();
  if (child == 0) {
    end_on_interrupt(file.parent_path().string(), "finished cases are kept");
    try {
      Journal journal(file, Journal::Mode::resume);
      RunPlan plan = fake_plan(cases);
      run_cases(
          plan,
          [](const Case&) {
            std::this_thread::sleep_for(std::chrono::microseconds(300));
            return std::make_unique<FakeSubject>(10.0);
          },
          journal);
    } catch (const std::exception&) {
      _exit(9);
    }
    _exit(0);
  }
  if (kill_after_ms >= 0) {
    std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(kill_after_ms));
    kill(child, signal_number);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

std::string without_times(Row row) {
  for (const char* key : {"utc", "started_s", "load", "load_after", "cpu_mhz", "cpu_mhz_after",
                          "other_cpu_share", "prepare_s", "sampling_s", "check_s"})
    row.provenance.erase(key);
  for (auto& [phase, samples] : row.samples) samples = {};
  row.first_launch_ms = 0;
  return to_line(row);
}

std::vector<std::string> contents(const fs::path& file) {
  std::vector<std::string> lines;
  for (const Row& row : read_contents(file).rows) lines.push_back(without_times(row));
  return lines;
}

TEST_F(Runner, KilledAndResumedGivesTheSameRows) {
  const int cases = 24;
  ASSERT_EQ(run_in_child(folder.path / "whole.jsonl", cases, -1, 0), 0);
  const auto whole = contents(folder.path / "whole.jsonl");
  ASSERT_EQ(whole.size(), std::size_t(cases));

  std::mt19937_64 random(20261121);
  int killed = 0;
  for (int moment = 0; moment < 100; ++moment) {
    const fs::path file = folder.path / ("k" + std::to_string(moment) + ".jsonl");
    const double after_ms = double(random() % 40000) / 1000;
    killed += WIFSIGNALED(run_in_child(file, cases, after_ms, SIGKILL));
    const std::string before = fs::exists(file) ? text_of(file) : "";
    ASSERT_EQ(run_in_child(file, cases, -1, 0), 0);
    EXPECT_EQ(contents(file), whole) << "moment " << moment;
    // The resumed run must not change the lines of the journal that were complete when the first run was
    // killed.
    const std::string acknowledged = before.substr(0, before.rfind('\n') + 1);
    EXPECT_EQ(text_of(file).substr(0, acknowledged.size()), acknowledged);
  }
  EXPECT_GE(killed, 20) << "too few of the kills hit a running sweep";
}

TEST_F(Runner, InterruptedEndsWithItsCodeAndAWholeJournal) {
  std::mt19937_64 random(1);
  int interrupted = 0;
  for (int moment = 0; moment < 30; ++moment) {
    const int number = moment % 2 ? SIGINT : SIGTERM;
    const fs::path file = folder.path / ("i" + std::to_string(moment) + ".jsonl");
    const int status = run_in_child(file, 24, double(random() % 30000) / 1000, number);
    if (!WIFEXITED(status)) continue;  // killed before the handler was installed
    if (WEXITSTATUS(status) == 0) continue;
    EXPECT_EQ(WEXITSTATUS(status), 128 + number);
    ++interrupted;
    const std::string text = fs::exists(file) ? text_of(file) : "";
    EXPECT_TRUE(text.empty() || text.back() == '\n') << "no row may be torn by a signal";
  }
  EXPECT_GE(interrupted, 10);
}

void hold_and_interrupt() {
  end_on_interrupt("/", "rows are kept");
  const HoldInterrupt outer;
  {
    const HoldInterrupt inner;
    raise(SIGTERM);
  }
  std::fputs("held", stderr);
}

TEST(Interrupt, EndsAtOnceOrAfterTheLastHold) {
  EXPECT_EXIT((end_on_interrupt("/", "rows are kept"), raise(SIGINT)), testing::ExitedWithCode(130),
              "interrupted; rows are kept");
  EXPECT_EXIT((end_on_interrupt("/none", "rows are kept"), raise(SIGINT)), testing::ExitedWithCode(130),
              "interrupted; nothing was recorded");
  EXPECT_EXIT(hold_and_interrupt(), testing::ExitedWithCode(143), "held\npelage: interrupted; rows are kept");
}

}  // namespace
}  // namespace pelage
