// Tests correct runs that resemble the faulty ones of the other tests: pelage must neither refuse their
// results nor divide them. docs/results.md names them.

#include "harness/record/identity.hpp"
#include "harness/report/report.hpp"
#include "tests/planted/runs.hpp"

namespace pelage::planted {
namespace {

struct Honest : Runs {
  /// Runs the experiment `text` with the options. Expects that all rows are ok, and that a report would
  /// contain every row and every case.
  void run(const std::string& text, const std::string& options = "", const std::string& results = "results") {
    folder.write("own.toml", text);
    done("run own.toml -o " + results + " " + options);
    expect_whole({path(results)});
  }
  /// Expects that all cases have a row with the status ok, and that a report would put all rows into one set.
  static void expect_whole(const std::vector<fs::path>& places) {
    const std::vector<std::string> names(places.begin(), places.end());
    const Results results = read_all_results(names);
    EXPECT_FALSE(results.rows.empty());
    for (const FoundRow& found : results.rows) EXPECT_EQ(found.row.status, Status::ok) << found.row.reason;
    for (const LeftOut& one : results.left_out) ADD_FAILURE() << one.reason;
    for (const LeftOut& one : missing_cases(journals_of(names), results.rows)) ADD_FAILURE() << one.reason;
    for (const LeftOut& one : without_numbers(cells_of(results.rows), results.rows))
      ADD_FAILURE() << one.reason;
    EXPECT_TRUE(kept_apart(places).empty());
  }
  void expect_resumed(const std::string& options = "", const std::string& file = "own.toml") {
    const Outcome again = done(options + " run " + file + " --resume results");
    expect_has(again.err, {"pelage: 0 cases ok, 0 cases not ok, ", " kept from the interrupted run"});
  }
  /// Expects that the resumed run measured the one missing case, and that it kept the row of the other case.
  void expect_one_more(const Outcome& again) {
    EXPECT_EQ(again.code, 0) << again.err;
    expect_has(again.err, "1 cases ok, 0 cases not ok, 1 kept");
    expect_whole({path("results")});
  }
};

TEST_F(Honest, FinishedRunResumed) {
  take("base");
  expect_resumed();
}

TEST_F(Honest, ResumeAfterAKill) {
  take("base");
  fs::resize_file(journal(), fs::file_size(journal()) - 20);
  expect_one_more(resume());
}

TEST_F(Honest, ResumeAfterAnError) {
  take("base");
  reseal([this](Row& row) {
    if (row.case_name != rows().front().case_name) return;
    row.status = Status::error;
    row.reason = "disk full";
    row.samples.clear();
  });
  const Outcome again = resume();
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(rows().size(), 2U);
  for (const Row& row : rows()) EXPECT_EQ(row.status, Status::ok) << row.reason;
  const Results results = read_all_results({path("results").string()});
  ASSERT_EQ(results.left_out.size(), 1U) << "the list names the row with the error";
  EXPECT_EQ(results.left_out.front().reason, "error: disk full; a later row replaces this one");
}

TEST_F(Honest, ResumeOfTheOtherHalf) {
  folder.write("own.toml", base_experiment());
  done("run own.toml --filter -4- -o results");
  expect_one_more(resume());
}

TEST_F(Honest, UnusedKernelEdited) {
  take("base");
  edit_kernel("springs/gradients.cl", "\n", "\n// edited\n");
  expect_resumed("--kernels mine");
}

TEST_F(Honest, CommentInTheScene) {
  take("base");
  folder.edit("own.toml", "[scene]", "# a comment\n[scene] # another one");
  expect_resumed();
}

TEST_F(Honest, MovedCheckout) {
  take("base");
  fs::copy(PELAGE_SOURCE_DIR "/kernels", path("elsewhere"), fs::copy_options::recursive);
  fs::create_directory(path("deep"));
  fs::rename(path("own.toml"), path("deep/renamed.toml"));
  expect_resumed("--kernels elsewhere", "deep/renamed.toml");
}

TEST_F(Honest, CopyOfAFolderAlone) {
  take("base");
  fs::copy(path("results"), path("copy"), fs::copy_options::recursive);
  fs::remove_all(path("results"));
  expect_whole({path("copy")});
}

TEST_F(Honest, RenamedFolder) {
  take("base");
  fs::create_directory(path("kept"));
  fs::rename(path("results"), path("kept/of monday"));
  fs::rename(path("kept"), path("results"));
  expect_whole({path("results")});
}

TEST_F(Honest, RepeatedInProcesses) {
  run(base_experiment(), "--filter -4- --repeat 2");
  const std::vector<Cell> cells = cells_in({path("results")});
  ASSERT_EQ(cells.size(), 1U);
  EXPECT_EQ(cells.front().timings.processes.size(), 2U);
  EXPECT_FALSE(cells.front().picture_hashes.empty());
}

TEST_F(Honest, TwoRunsOfOneScene) {
  take("base");
  const Outcome second = done("run own.toml --filter -4- -o second");
  expect_whole({path("results"), path("second")});
  EXPECT_EQ(cells_in({path("results"), path("second")}).front().timings.processes.size() +
                cells_in({path("results"), path("second")}).back().timings.processes.size(),
            3U);
}

TEST_F(Honest, MergedShards) {
  folder.write("own.toml", base_experiment());
  for (const char* options : {"--shard 0/2 -o s0", "--shard 1/2 -o s1"})
    done(std::string("run own.toml --host nodes ") + options);
  done("merge results s0 s1");
  EXPECT_EQ(rows().size(), 2U);
  expect_whole({path("results")});
}

TEST_F(Honest, MeshFilesAndACoatOfOnesOwn) {
  take("files");
  expect_whole({path("results")});
  for (const char* file : {"own.obj", "buffered.gltf", "own.bin", "own.png"})
    fs::last_write_time(path(file), fs::file_time_type::clock::now());
  expect_resumed();
}

TEST_F(Honest, ChangedByTheCommandLine) {
  folder.write("own.toml", base_experiment());
  const std::string command = "run own.toml --filter -4- --set fur.length=0.12 ";
  done(command + "-o results");
  expect_whole({path("results")});
  done(command + "--resume results");
}

TEST_F(Honest, WetFur) {
  run(of_torus("layers = [4]", "shading.model = \"wet\"\nwetness.random = 60"));
}

TEST_F(Honest, CurledFur) {
  run(of_torus("layers = [4]", "curl.radius = 0.05\ncurl.turns = 2.0"));
}

TEST_F(Honest, MassSprings) {
  run(of_torus("layers = [4]", "dynamics.topology = \"sticks\"\ndynamics.wind.strength = 0.05"));
  expect_resumed();
}

TEST_F(Honest, AnotherMapping) {
  run(of_torus("layers = [4]"), "--mapping pixel");
}

TEST_F(Honest, FramesInTurns) {
  run(of_torus("variant = [\"fewer\"]\nlayers = [8]") + "[variant.fewer]\npipeline = \"shells+fewer\"\n");
}

TEST_F(Honest, AChangeOfTheSceneInTurns) {
  run(of_torus("variant = [\"turns\"]\nlayers = [8]\nreading = [\"plain\", \"curled\"]") +
      "[variant.turns]\npipeline = \"shells+baseline\"\n[reading.curled]\ncurl.radius = 0.03\n");
}

TEST_F(Honest, SolverWithoutAPicture) {
  run(experiment("variant = [\"springs\"]\nmodel = [\"torus-24x12\"]", "dynamics.topology = \"sticks\"") +
      "[variant.springs]\npipeline = \"springs+rivals\"\n");
}

TEST_F(Honest, OpenGlBaseline) {
  folder.write("own.toml", of_torus("variant = [\"opengl\"]\nlayers = [4]") +
                               "[variant.opengl]\npipeline = \"shells+opengl\"\n");
  done("run own.toml -o results");
  if (rows().front().status == Status::unsupported) GTEST_SKIP() << rows().front().reason;
  expect_whole({path("results")});
  EXPECT_TRUE(rows().front().identity.contains(renderer_part));
  expect_resumed();
}

TEST_F(Honest, RunWithoutNames) {
  run(base_experiment(), "--filter -4- --anonymous");
}

TEST_F(Honest, RecordingsOfTheRepository) {
  const Results results = read_all_results({PELAGE_SOURCE_DIR "/results"});
  EXPECT_GT(results.rows.size(), 700U);
  for (const LeftOut& one : results.left_out) ADD_FAILURE() << one.where << ": " << one.reason;
}

}  // namespace
}  // namespace pelage::planted
