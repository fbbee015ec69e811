// A fake pipeline that needs no device, and experiment cases for it.
#pragma once
#include <string>

#include "harness/hash.hpp"
#include "harness/measure/runner.hpp"
#include "tests/support/files.hpp"

namespace pelage::test {

/// Adds up to 0.01 ms to the first frame time of the row. The amount depends on `text`, so rows of different
/// cases or runs get different times, as in real measurements.
inline void vary_times(Row& row, const std::string& text) {
  row.samples["frame"].wall_ms.front() += 1e-5 * double(Hash().text(text).value() % 997);
}

inline Row sample_row(const std::string& name) {
  Row row;
  row.run_id = "20261121T000000Z-1";
  row.experiment = "fake";
  row.case_name = name;
  row.variant = "shells/tile";
  row.axes = {{"model", "torus"}, {"layers", "16"}, {"size", "800x600"}};
  row.device = "a \"device\", with\ttab";
  row.check = {{"reference", "psnr", 71.5, 60, true}, {"reference", "p99.9", 0.0039, 0.0078, false}};
  row.samples["frame"] = {{4, 4.5, 5e-4}, {10.75, 11.0, 1e-3}, {20.5, 21.25, 0}};
  row.samples["raster"] = {{4, 4.5, 5e-4}, {}};
  vary_times(row, name);
  row.metrics["triangles"] = {9360, "triangles"};
  row.metrics["paper_fps"] = {1, "fps", "<", std::nullopt, 1.0};
  row.build_ms = 812.5;
  row.first_launch_ms = 33;
  row.tuning = {{"TILE_W", 16}};
  row.image_hash = "0123456789abcdef";
  row.provenance = {{"utc", "2026-11-21T00:00:00Z"}, {"argv", {"pelage", "run"}}};
  return row;
}

/// A subject (an object whose frames an experiment times) that draws a grey picture of 2 x 2 pixels. The
/// reported frame time begins at `first_ms` and grows by 0.001 ms per frame.
class FakeSubject : public Subject {
 public:
  explicit FakeSubject(double first_ms, double psnr = 80) : next_ms_(first_ms), psnr_(psnr) {}
  FrameSample frame() override {
    ++frames;
    next_ms_ += 0.001;
    return {next_ms_, {{"raster", next_ms_ - 1}}};
  }
  Picture read() override { return {2, 2, std::vector<glm::vec4>(4, glm::vec4(0.5f, 0.5f, 0.5f, 1.0f))}; }
  std::vector<Check> check(const Picture&) override { return {{"reference", "psnr", psnr_, 60, true}}; }
  void describe(Row& row) override { row.metrics["triangles"] = {12, "triangles"}; }
  int frames = 0;

 private:
  double next_ms_, psnr_;
};

inline std::vector<Case> fake_cases(int count) {
  std::vector<Case> cases;
  for (int i = 0; i < count; ++i) {
    Case c;
    c.name = "case" + std::to_string(i);
    c.variant = "shells/tile";
    c.axes = {{"model", std::to_string(i)}};
    cases.push_back(c);
  }
  return cases;
}

inline RunPlan fake_plan(int count) {
  RunPlan plan;
  plan.run_id = "run";
  plan.experiment = "fake";
  plan.device = "fake";
  plan.cases = fake_cases(count);
  plan.limits = {0, 2, 4, 0.5, 1};
  plan.provenance = nlohmann::ordered_json::object();
  return plan;
}

}  // namespace pelage::test
