// Tests that pelage detects faulty rows: copies, incomplete lines, damaged lines, and changed rows with a
// new, correct checksum. The first table of docs/results.md lists these tests.

#include <algorithm>

#include "tests/planted/runs.hpp"
#include "tests/support/texts.hpp"

namespace pelage::planted {
namespace {

TEST_F(Planted, RowCopiedWithinAJournal) {
  take("base");
  const std::string text = folder.read(fs::relative(journal(), folder.path).string());
  std::ofstream(journal(), std::ios::app | std::ios::binary) << text.substr(0, text.find('\n') + 1);
  expect_unreadable(":3: damaged: second row with the key own|");
}

TEST_F(Planted, ResultsGivenTwice) {
  take("base");
  const std::vector<Cell> cells = cells_in({path("results"), path("results")});
  ASSERT_EQ(cells.size(), 2U);
  for (const Cell& cell : cells) EXPECT_EQ(cell.timings.processes.size(), 1U);
}

TEST_F(Planted, CopyOfAFolder) {
  take("base");
  take("base", "copy");
  const Results results = read_all_results({path("results").string(), path("copy").string()});
  EXPECT_EQ(results.rows.size(), 2U);
  ASSERT_EQ(results.left_out.size(), 2U);
  expect_has(results.left_out.front().reason, "copy of a row of ");
  for (const Cell& cell : cells_of(results.rows)) EXPECT_EQ(cell.timings.processes.size(), 1U);
}

TEST_F(Planted, CopyThatClaimsToBeAnotherRun) {
  take("base");
  take("base", "copy");
  reseal([](Row& row) { row.run_id += "1", row.repeat = 1; }, "copy");
  refused(pelage("export results copy"), "their 6 frame times are equal");
}

TEST_F(Planted, CopyWithChangedTimes) {
  take("base");
  take("base", "copy");
  reseal(slow_down, "copy");
  refused(pelage("export results copy"), "but the two rows differ");
}

TEST_F(Planted, RowOfAnotherCase) {
  take("base");
  const Row first = rows().front();
  reseal([&](Row& row) {
    const Row own = row;
    row = first;
    row.case_name = own.case_name;
    row.axes = own.axes;
  });
  expect_unreadable("the seed of the row's check is not the seed of a case with the name ");
}

TEST_F(Planted, TornLastLine) {
  take("base");
  fs::resize_file(journal(), fs::file_size(journal()) - 20);
  const Results results = read_all_results({path("results").string()});
  EXPECT_EQ(results.rows.size(), 1U);
  ASSERT_EQ(results.left_out.size(), 1U);
  expect_has(results.left_out.front().reason, "is not complete");
  expect_has(pelage("export results").err, "is not complete");
  done("report results -o page");
  for (const char* file :
       {"stdout", "page/tables/left-out.csv", "page/tables/left-out.tex", "page/index.html"}) {
    expect_has(folder.read(file), {"is not complete", "cases without a row: 1 of 2"});
  }
}

TEST_F(Planted, FlippedLine) {
  take("base");
  folder.edit(fs::relative(journal(), folder.path).string(), "\"wall_ms\":[", "\"wall_ms\":[1");
  expect_unreadable(":1: damaged: the checksum does not match the row");
}

TEST_F(Planted, OkWithAFailingCheck) {
  take("base");
  reseal([](Row& row) {
    for (Check& check : row.check)
      if (check.metric == "psnr") check.value = 20;
  });
  expect_unreadable("the row is ok, but its check psnr against reference does not hold");
}

TEST_F(Planted, OkWithoutAnyCheck) {
  take("base");
  reseal([](Row& row) { row.check.clear(); });
  expect_unreadable("the row is ok, but nothing was checked");
}

TEST_F(Planted, RenamedDevice) {
  take("base");
  reseal([](Row& row) { row.device = "a faster device"; });
  expect_unreadable("the row is of the device 'a faster device', but its provenance says");
}

TEST_F(Planted, RenamedDeviceAndProvenance) {
  take("base");
  reseal([](Row& row) {
    row.device = "a faster device";
    row.provenance["device_name"] = row.device;
  });
  expect_unreadable("but the provenance of the row gives");
}

/// The function `change` changes a row, and the test then writes the row with a correct checksum. pelage must
/// refuse the row with a message that contains `text`.
struct Contradiction {
  const char* name;
  std::function<void(Row&)> change;
  const char* text;
};

using Times = std::vector<double>;

Times& wall(Row& row) {
  return row.samples["frame"].wall_ms;
}

void add(Times& times, double ms) {
  for (double& time : times) time += ms;
}

Check& psnr_of(Row& row) {
  return *std::find_if(row.check.begin(), row.check.end(), [](const Check& c) { return c.metric == "psnr"; });
}

std::vector<Contradiction> contradictions() {
  return {
      {"no times", [](Row& r) { r.samples.clear(); }, "it has no times of frames"},
      {"no times of frames", [](Row& r) { wall(r).clear(); }, "it has no times of frames"},
      {"a negative time", [](Row& r) { wall(r)[1] = -1; }, "wall times of the phase frame is -1 ms"},
      {"a time of 0", [](Row& r) { wall(r)[1] = 0; }, "wall times of the phase frame is 0 ms"},
      {"a time that is not a number", [](Row& r) { wall(r)[1] = std::nan(""); }, "this line is not a row"},
      {"fewer event times than frames", [](Row& r) { r.samples["frame"].event_ms.pop_back(); },
       "event times of the phase frame, but 6 timed frames"},
      {"fewer CPU times than frames", [](Row& r) { r.samples["frame"].cpu_ms.pop_back(); },
       "CPU times of the phase frame, but 6 timed frames"},
      {"more frames", [](Row& r) { wall(r).push_back(1); }, "but 7 timed frames"},
      {"a phase that is longer than the frame", [](Row& r) { r.samples["raster"].event_ms[0] += 1e6; },
       "the event times of the phases of a frame sum to"},
      {"event times above the wall time",
       [](Row& r) { add(r.samples["raster"].event_ms, 1e6), add(r.samples["frame"].event_ms, 1e6); },
       "the median event time of a frame is"},
      {"more CPU time than the CPUs have", [](Row& r) { add(r.samples["frame"].cpu_ms, 1e9); },
       "the median CPU time of the phase frame is"},
      {"converged after two frames",
       [](Row& r) {
         for (auto& [phase, times] : r.samples)
           for (Times* list : {&times.wall_ms, &times.event_ms, &times.cpu_ms})
             if (!list->empty()) list->resize(2);
         r.metrics.erase("fragments_per_s");
         r.provenance["converged"] = true;
       },
       "the row says that its median converged, but it has only 2 timed frames"},
      {"faster frames, the same rate of fragments",
       [](Row& r) {
         for (double& ms : wall(r)) ms *= 2;
       },
       "the metric fragments_per_s is"},
      {"a higher rate of fragments", [](Row& r) { r.metrics["fragments_per_s"].value *= 2; },
       "the metric fragments_per_s is"},
      {"times of a failed case", [](Row& r) { r.status = Status::failed_check, r.reason = "psnr"; },
       "the row has the status failed-check, but it has times"},
      {"a weaker limit", [](Row& r) { psnr_of(r).value = 30, psnr_of(r).limit = 20; },
       "has the limit >= 20, which is weaker than pelage's"},
      {"a limit in the other direction", [](Row& r) { psnr_of(r).value = 30, psnr_of(r).at_least = false; },
       "has the limit <= 60, which is weaker than pelage's"},
      {"a scene that is no hash", [](Row& r) { r.identity["scene"] = "beef"; },
       "part scene is 'beef', not a hash"},
      {"another scene", [](Row& r) { r.identity["scene"] = "0123456789abcdef"; },
       "but scene_hash of the row gives"},
      {"another mesh", [](Row& r) { r.identity["mesh"] = "0123456789abcdef"; },
       "but mesh_hash of the row gives"},
      {"another device", [](Row& r) { r.identity["device"] = "0123456789abcdef"; },
       "but the provenance of the row gives"},
      {"another driver", [](Row& r) { r.provenance["driver"] = "4.0"; },
       "but the provenance of the row gives"},
      {"another tuning", [](Row& r) { r.tuning["TILE_W"] = 16; }, "but tuning of the row gives"},
      {"a picture that is no hash", [](Row& r) { r.image_hash = "same"; },
       "image_hash is 'same', not a hash"},
  };
}

TEST_F(Planted, ContradictingFields) {
  take("base");
  const Row honest = rows().front();
  ASSERT_EQ(test::refusal([&] { row_from_line(to_line(honest)); }), "accepted");
  if (honest.samples.at("frame").event_ms.empty()) GTEST_SKIP() << "the device has no event timer";
  for (const Contradiction& planted : contradictions()) {
    Row row = honest;
    planted.change(row);
    const std::string text = test::refusal([&] { row_from_line(to_line(row)); });
    EXPECT_TRUE(has(text, planted.text)) << planted.name << ": " << text;
  }
}

/// The changed rows claim that their medians have the precision 0.005. The 95% interval of the changed times
/// is wider, so the rows must not count as converged.
TEST_F(Planted, FalseConvergence) {
  take("base");
  reseal([](Row& row) {
    wall(row) = {100, 100, 100, 101, 150, 160};
    row.metrics.erase("fragments_per_s");
    row.provenance["precision"] = 0.005;
    row.provenance["converged"] = true;
    row.samples["frame"].event_ms.clear();
    std::erase_if(row.samples, [](const auto& phase) { return phase.first != "frame"; });
  });
  // Both rows now have equal times. pelage would refuse to read them together, so each row is read alone.
  for (const Row& row : rows()) {
    const std::vector<Cell> cells = cells_of({{row, journal()}});
    ASSERT_EQ(cells.size(), 1U);
    EXPECT_FALSE(cells.front().converged);
  }
}

}  // namespace
}  // namespace pelage::planted
