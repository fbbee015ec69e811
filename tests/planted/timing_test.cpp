// Tests that pelage detects wrong times, and pictures that do not show the timed frames. The first table of
// docs/results.md lists these tests.
#include "harness/measure/interruptions.hpp"
#include "harness/measure/runner.hpp"
#include "harness/subjects/case_identity.hpp"
#include "harness/subjects/pipelines.hpp"
#include "tests/planted/runs.hpp"
#include "tests/support/busy.hpp"
#include "tests/support/texts.hpp"

namespace pelage::planted {
namespace {

/// A subject draws and times the frames of one case. This class passes all calls to a real subject. Derived
/// classes override one function to simulate a fault.
class Faulty : public Subject {
 public:
  explicit Faulty(std::unique_ptr<Subject> real) : real_(std::move(real)) {}
  FrameSample frame() override { return real_->frame(); }
  Picture read() override { return real_->read(); }
  std::vector<Check> check(const Picture& timed) override { return real_->check(timed); }
  void describe(Row& row) override { real_->describe(row); }

 protected:
  std::unique_ptr<Subject> real_;
};

/// Times the first case of own.toml in this process. The subject is a `Fault` that wraps the real subject.
/// The constructor of `Fault` gets the real subject and then `arguments`.
template <class Fault, class... Arguments>
Row time_faulty(const Folder& folder, Arguments... arguments) {
  const Experiment own = read_experiment(folder.path / "own.toml");
  const auto context = make_context(cl::choose_device(""), own, {}, [](const std::string&) {});
  RunPlan plan;
  plan.run_id = "run";
  plan.experiment = own.name;
  plan.device = context->device.info().name;
  plan.limits = preset_of(own, "quick").limits;
  plan.identity = [&](const Case& which) { return case_identity(*context, which, plan.limits); };
  Case which = cases_of(own, preset_of(own, "quick")).front();
  if (which.mapping.empty()) which.mapping = "tile";
  const MakeSubject make = subjects_of(context);
  return run_case(plan, which, plan.limits,
                  [&](const Case& one) { return std::make_unique<Fault>(make(one), arguments...); });
}

/// Runs one case of base_experiment() with the kernel sources of the folder `mine`, and expects exit code 1
/// and a row without times.
Row row_with_kernels(const Folder& folder) {
  folder.write("own.toml", base_experiment());
  const Outcome outcome =
      cli::pelage(folder, "--kernels mine run own.toml --filter -4- --mapping tile -o results");
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  const std::vector<FoundRow> rows = read_results({(folder.path / "results").string()});
  EXPECT_EQ(rows.size(), 1U);
  EXPECT_TRUE(rows.front().row.samples.empty());
  return rows.front().row;
}

/// Simulates a renderer whose picture never changes after the first frame.
struct Stale : Faulty {
  using Faulty::Faulty;
  FrameSample frame() override {
    FrameSample sample = real_->frame();
    if (first.pixel.empty()) first = real_->read();
    return sample;
  }
  Picture read() override { return first; }
  Picture first;
};

TEST_F(Planted, StalePicture) {
  folder.write("own.toml", base_experiment());
  const Row row = time_faulty<Stale>(folder);
  EXPECT_EQ(row.status, Status::failed_check) << row.reason;
}

TEST_F(Planted, PictureFileOfAnotherRun) {
  take("base");
  take("other", "second");
  for (const char* layers : {"4", "8"}) {
    const std::string name = std::string("/own/images/torus_24x12-") + layers + "-320x240.png";
    ASSERT_NE(folder.read("results" + name), folder.read("second" + name));
    fs::copy_file(path("second" + name), path("results" + name), fs::copy_options::overwrite_existing);
  }
  done("report results -o page");
  expect_has(folder.read("page/tables/left-out.csv"),
             "picture: the file is not the picture that the row recorded");
  EXPECT_TRUE(fs::is_empty(path("page/images")));
}

TEST_F(Planted, KernelThatWritesNothing) {
  edit_kernel("rasterize/tile/tile.cl", "  RasterBuffers of = RASTER_RECORD;\n",
              "  if (s.tiles_x > 0) return;\n  RasterBuffers of = RASTER_RECORD;\n");
  const Row row = row_with_kernels(folder);
  EXPECT_TRUE(row.status == Status::failed_check || row.status == Status::diverged) << row.reason;
}

TEST_F(Planted, PictureThatIsNotANumber) {
  edit_kernel("rasterize/tile/tile.cl", "    uint fragments = draw_tile(",
              "    image[0] = (float4)(NAN);\n    uint fragments = number == 0 ? 0 : draw_tile(");
  const Row row = row_with_kernels(folder);
  EXPECT_EQ(row.status, Status::diverged) << row.reason;
}

TEST_F(Planted, SimulationThatStandsStill) {
  edit_kernel("simulate/simulate.cl", "  for (int i = 0; i < s.substeps; ++i) {",
              "  for (int i = 0; i < s.substeps - s.substeps; ++i) {");
  const Row row = row_with_kernels(folder);
  EXPECT_EQ(row.status, Status::failed_check) << row.reason;
}

/// Replaces the file `old_` by the file `new_` during the first frame.
struct Editor : Faulty {
  Editor(std::unique_ptr<Subject> real, fs::path old_file, fs::path new_file)
      : Faulty(std::move(real)), old_(std::move(old_file)), new_(std::move(new_file)) {}
  FrameSample frame() override {
    if (fs::exists(new_)) fs::rename(new_, old_);
    return real_->frame();
  }
  fs::path old_, new_;
};

TEST_F(Planted, TextureEditedDuringTheRun) {
  folder.write("own.toml", of_torus("layers = [4]", "coat.image = \"own.png\""));
  write_red(path("own.png"), 0.5F);
  write_red(path("new.png"), 0.1F);
  const Row row = time_faulty<Editor>(folder, path("own.png"), path("new.png"));
  EXPECT_EQ(row.status, Status::error);
  expect_has(row.reason, "but scene_hash of the row gives");
  EXPECT_TRUE(row.samples.empty());
  EXPECT_EQ(test::refusal([&] { row_from_line(to_line(row)); }), "accepted") << "the journal stays readable";
}

/// Simulates a driver with wrong event times. If `constant` is above 0, every event time is `constant`.
/// Otherwise, every event time is `factor` times the true event time.
struct FakeTimer : Faulty {
  FakeTimer(std::unique_ptr<Subject> real, double by, double same)
      : Faulty(std::move(real)), factor(by), constant(same) {}
  FrameSample frame() override {
    FrameSample sample = real_->frame();
    for (auto& [phase, ms] : sample.phase_event_ms) ms = constant > 0 ? constant : factor * ms;
    return sample;
  }
  double factor, constant;
};

TEST_F(Planted, FakeTimer) {
  folder.write("own.toml", base_experiment());
  for (const auto& [factor, constant] : {std::pair{1e6, 0.0}, std::pair{1.0, 0.1}}) {
    const Row row = time_faulty<FakeTimer>(folder, factor, constant);
    ASSERT_EQ(row.status, Status::ok) << row.reason;
    for (const auto& [phase, times] : row.samples)
      EXPECT_TRUE(times.event_ms.empty()) << phase << " " << factor;
    expect_has(row.provenance.value("event_times", ""), "left out: ");
    EXPECT_EQ(row.samples.at("frame").wall_ms.size(), 6U);
    EXPECT_EQ(test::refusal([&] { row_from_line(to_line(row)); }), "accepted");
  }
}

/// Adds one hour to the time of the first frame, as if the driver compiled the kernels during this frame.
struct Compiling : Faulty {
  using Faulty::Faulty;
  FrameSample frame() override {
    FrameSample sample = real_->frame();
    if (first) sample.wall_ms += hour_ms;
    first = false;
    return sample;
  }
  bool first = true;
  static constexpr double hour_ms = 3.6e6;
};

TEST_F(Planted, CompileTimeInside) {
  folder.write("own.toml", base_experiment());
  const Row row = time_faulty<Compiling>(folder);
  ASSERT_EQ(row.status, Status::ok) << row.reason;
  EXPECT_GE(row.first_launch_ms, Compiling::hour_ms);
  for (const double ms : row.samples.at("frame").wall_ms) EXPECT_LT(ms, Compiling::hour_ms);
  EXPECT_GT(row.build_ms, 0) << "the time of the build stands apart, too";
}

/// The library tests/planted/preload/clock.cpp makes the wall clock jump by days. Every time in the row must
/// be shorter than one hour, which shows that the time contains no jump.
TEST_F(Planted, WallClockThatSteps) {
  folder.write("own.toml", base_experiment());
  done("run own.toml --filter -4- -o results",
       "ASAN_OPTIONS=detect_leaks=0:verify_asan_link_order=0 LD_PRELOAD='" PELAGE_CLOCK "'");
  const Row row = rows().front();
  EXPECT_EQ(row.status, Status::ok);
  for (const auto& [phase, times] : row.samples)
    for (const auto* list : {&times.wall_ms, &times.event_ms, &times.cpu_ms})
      for (const double ms : *list) EXPECT_LT(ms, Compiling::hour_ms) << phase;
  for (const double ms :
       {row.build_ms, row.first_launch_ms, 1000 * row.provenance.at("sampling_s").get<double>()})
    EXPECT_TRUE(ms > 0 && ms < Compiling::hour_ms) << ms;
}

TEST_F(Planted, LoadedMachine) {
  if (!std::ifstream("/proc/stat")) GTEST_SKIP() << "no /proc/stat";
  folder.write("own.toml", base_experiment());
  folder.edit("own.toml", "warm_up_s = 0.0", "warm_up_s = 1.0");
  {
    const test::BusyMachine busy;
    expect_has(done("run own.toml --filter -4- -o results").err,
               "pelage: warning: torus_24x12-4-320x240: other processes took ");
  }
  EXPECT_FALSE(rows().front().samples.at("frame").cpu_ms.empty());
  const std::vector<Cell> cells = cells_in({path("results")});
  ASSERT_EQ(cells.size(), 1U);
  EXPECT_EQ(cells.front().status, Status::ok);
  EXPECT_TRUE(cells.front().contended);
  done("report results -o page");
  for (const char* file : {"stdout", "page/tables/own.tex", "page/index.html"})
    expect_has(folder.read(file), "! other processes used more than 10");
  expect_has(pelage("export results").out, ",contended,");
}

// The program is stopped several times while it times the case. The first run compiles its kernels.
TEST_F(Planted, StoppedProgram) {
  take("base");
  folder.edit("own.toml", "warm_up_s = 0.0", "warm_up_s = 4.0");
  ASSERT_EQ(
      shell(std::string(PELAGE_BINARY) +
            " run own.toml --filter -4- -o stopped & p=$!; sleep 1; "
            "for i in 1 2 3 4 5 6; do kill -STOP $p; sleep 0.2; kill -CONT $p; sleep 0.3; done; wait $p"),
      0);
  expect_has(folder.read("stderr"), "pelage could not run: a signal stopped it ");
  EXPECT_GE(rows("stopped").front().provenance.at("stops"), 1);
  done("report stopped -o page");
  expect_has(folder.read("page/index.html"), "stopped, or asleep");
}

TEST_F(Planted, FewerCoresThanBefore) {
  if (usable_cores() < 2) GTEST_SKIP() << "one core";
  folder.write("own.toml", base_experiment());
  done("run own.toml --filter -4- -o results", "POCL_AFFINITY=0");
  expect_refused(pelage("run own.toml --resume results", "POCL_AFFINITY=0 taskset -c 0"), "device");
  done("run own.toml --filter -4- -o one", "POCL_AFFINITY=0 taskset -c 0");
  EXPECT_EQ(rows("one").front().provenance.at("usable_cores"), 1);
}

}  // namespace
}  // namespace pelage::planted
