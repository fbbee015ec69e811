// Tests the subjects that draw several pictures in turns in every round. Ratios are medians over the rounds,
// and a row fails if one of its pictures fails its check.
#include "harness/subjects/in_turns.hpp"

#include "tests/support/fake.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

const SamplingLimits six_to_ten{0, 6, 10, 0.5, 1};

Experiment two_readings() {
  Experiment e;
  e.name = "fake";
  e.axes = {{"model", {"torus", "pear"}}, {"reading", {"plain", "curled"}}, {"fur.layers", {"8", "16"}}};
  e.scene = {{"fur.length", "0.1"}, {"curl.radius", "0.0"}};
  e.at["reading"]["curled"] = {{"curl.radius", "0.03"}, {"curl.turns", "2.0"}};
  e.at["model"]["pear"] = {{"fur.length", "0.09"}};
  e.presets["quick"] = {};
  return e;
}

Case case_named(const Experiment& e, const std::string& name) {
  for (const Case& c : cases_of(e, e.presets.at("quick"), {}))
    if (c.name == name) return c;
  throw std::logic_error("no case " + name);
}

TEST(Baseline, HasTheFirstValueOfNamedAxesAndAllOtherSettings) {
  const Experiment e = two_readings();
  const Case curled = case_named(e, "pear-curled-16"), plain = control_case(e, curled);
  EXPECT_EQ(curled.settings.at("curl.radius"), "0.03");
  EXPECT_EQ(plain.settings.at("curl.radius"), "0.0");
  EXPECT_FALSE(plain.settings.contains("curl.turns"));
  EXPECT_EQ(plain.settings.at("fur.length"), "0.09");
  EXPECT_EQ(plain.axes, case_named(e, "pear-16").axes);
  EXPECT_EQ(plain.set, curled.set);
  EXPECT_EQ(plain.settings, case_named(e, "pear-16").settings);
  const auto own = cases_of(e, {}, {.axes = {{"size", {"4x3"}}}, .model = "m.obj"});
  EXPECT_EQ(control_case(e, own[3]).settings, own[1].settings);  // the options --axis and --model stay
  Experiment figures = two_readings();
  figures.axes.erase(figures.axes.begin());
  figures.at["reading"]["curled"] = {{"model", "\"pear\""}};
  EXPECT_FALSE(control_case(figures, case_named(figures, "curled-8")).settings.contains("model"));
  const Case changed = cases_of(figures, {}, {.set = {{"model", "bunny"}}}).front();
  EXPECT_EQ(control_case(figures, changed).set, changed.set);
}

/// Frames take 3 ms with curls and 2 ms without. If `bad` is the name of a case, its picture fails the check.
Row row_with_baseline(const std::string& bad = "") {
  const Experiment e = two_readings();
  const MakeSubject by_curls = [bad](const Case& which) {
    return std::make_unique<test::FakeSubject>(which.settings.at("curl.radius") == "0.0" ? 2 : 3,
                                               which.name == bad ? 40.0 : 80.0);
  };
  return run_case(test::fake_plan(1), case_named(e, "torus-curled-8"), six_to_ten,
                  [&](const Case& which) { return against_control_scene(by_curls, e, which); });
}

TEST(Baseline, IsTimedInTurnsWithTheCase) {
  const Row row = row_with_baseline();
  EXPECT_EQ(row.status, Status::ok) << row.reason;
  EXPECT_EQ(row.samples.at("baseline").wall_ms.size(), row.samples.at("frame").wall_ms.size());
  EXPECT_NEAR(row.metrics.at("frame_over_baseline").value, 1.5, 0.01);
  EXPECT_LE(row.metrics.at("frame_over_baseline").low, row.metrics.at("frame_over_baseline").value);
  EXPECT_EQ(row.metrics.at("baseline_psnr").value, 200);
  EXPECT_EQ(row.metrics.at("baseline_ssim").value, 1);
}

TEST(Baseline, ThatFailsItsCheckFailsTheRow) {
  EXPECT_EQ(row_with_baseline("torus-curled-8").status, Status::failed_check);
  const Row row = row_with_baseline("torus-8");
  EXPECT_EQ(row.status, Status::failed_check);
  test::expect_has(row.reason, "reference, baseline");
}

/// Frames take 1 ms per layer. The picture with the number of layers `bad` fails the check.
Row row_with_fewer(int layers, int bad = 0) {
  RunPlan plan = test::fake_plan(1);
  plan.cases[0].pipeline = "shells+fewer";
  const MakeSubject as_many_ms_as_layers = [bad](const Case& which) {
    EXPECT_EQ(which.set.back().first, "fur.layers");  // the last setting overrides the others
    const int count = std::stoi(which.set.back().second);
    return std::make_unique<test::FakeSubject>(double(count), count == bad ? 40.0 : 80.0);
  };
  return run_case(plan, plan.cases[0], six_to_ten,
                  [&](const Case& which) { return fewer_layers(as_many_ms_as_layers, which, layers); });
}

TEST(Layers, AreTimedInTurnsWithHalfAndAQuarterOfThem) {
  const Row row = row_with_fewer(64);
  EXPECT_EQ(row.status, Status::ok) << row.reason;
  EXPECT_EQ(row.samples.at("half").wall_ms.size(), row.samples.at("frame").wall_ms.size());
  // Each synthetic frame takes 0.001 ms longer than the frame before it. At most ten frames are drawn, so the
  // times increase by at most 0.01 ms.
  EXPECT_NEAR(row.metrics.at("frame_over_half").value, 2, 2 * 0.01 / 32);
  EXPECT_NEAR(row.metrics.at("frame_over_quarter").value, 4, 4 * 0.01 / 16);
  EXPECT_LE(row.metrics.at("frame_over_half").low, row.metrics.at("frame_over_half").value);
}

TEST(Layers, ThatFailTheirCheckFailTheRow) {
  for (const int bad : {64, 32, 16}) {
    const Row row = row_with_fewer(64, bad);
    EXPECT_EQ(row.status, Status::failed_check) << bad;
    EXPECT_TRUE(row.samples.empty());
  }
  test::expect_has(row_with_fewer(64, 16).reason, "reference, quarter");
}

TEST(Layers, MustBeAMultipleOfFour) {
  const Row row = row_with_fewer(6);
  EXPECT_NE(row.status, Status::ok);
  test::expect_has(row.reason, "fur.layers is 6; give a multiple of 4, because shells+fewer also draws");
}

/// A subject that draws a grey square. Its frames take 10 * factor ms, 11 * factor ms, 12 * factor ms, ...
class Grey : public test::FakeSubject {
 public:
  Grey(double factor, float grey, std::string* order)
      : FakeSubject(0), factor_(factor), grey_(grey), order_(order) {}
  FrameSample frame() override {
    *order_ += factor_ > 1 ? 'r' : 'o';
    return {factor_ * (10.0 + frames++), {}};
  }
  Picture read() override { return {2, 2, std::vector<glm::vec4>(4, glm::vec4(grey_, grey_, grey_, 1.0f))}; }
  void describe(Row& row) override {
    FakeSubject::describe(row);
    row.build_ms = factor_;
    row.provenance[factor_ > 1 ? "rival_says" : "ours_says"] = "here";
  }

 private:
  double factor_;
  float grey_;
  std::string* order_;
};

Row fought(float rivals_grey, std::string* order) {
  const RunPlan plan = test::fake_plan(1);
  return run_case(plan, plan.cases[0], {0, 6, 6, 1.0, 10}, [&](const Case&) {
    return with_opengl(std::make_unique<Grey>(1.0, 0.5f, order),
                       std::make_unique<Grey>(8.0, rivals_grey, order));
  });
}

TEST(Duel, AlternatesAndGivesTheRatioOfEveryRound) {
  std::string order;
  const Row row = fought(0.5f, &order);
  // A round draws one frame with our pipeline (o) and then one frame with the baseline (r). There are eight
  // rounds: the first launch, one warm-up round, and six samples.
  EXPECT_EQ(order, "orororororororor");
  ASSERT_EQ(row.status, Status::ok) << row.reason;
  EXPECT_EQ(row.samples.at("frame").wall_ms, (std::vector<double>{12, 13, 14, 15, 16, 17}));
  EXPECT_EQ(row.samples.at("opengl").wall_ms, (std::vector<double>{96, 104, 112, 120, 128, 136}));
  const Metric ratio = row.metrics.at("opengl_ratio");
  EXPECT_DOUBLE_EQ(ratio.value, 8.0);
  EXPECT_DOUBLE_EQ(ratio.low.value(), 8.0);
  EXPECT_DOUBLE_EQ(ratio.high.value(), 8.0);
  EXPECT_EQ(row.build_ms, 1.0);
  EXPECT_EQ(row.metrics.at("opengl_build_ms").value, 8.0);
  EXPECT_TRUE(row.provenance.contains("ours_says") && row.provenance.contains("rival_says"));
  EXPECT_EQ(row_from_line(to_line(row)).metrics.at("opengl_ratio").low, ratio.low);
}

TEST(Duel, AnotherPictureHasNoTime) {
  std::string order;
  const Row row = fought(0.498f, &order);  // the PSNR between the two pictures is 54 dB
  EXPECT_EQ(row.status, Status::failed_check);
  test::expect_has(row.reason, "psnr against opengl is 53.97");
  EXPECT_TRUE(row.samples.empty());
}

}  // namespace
}  // namespace pelage
