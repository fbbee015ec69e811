// Tests that subjects are timed in turns, and that the ratio of their times has one direction.
#include "harness/measure/turns.hpp"

#include "tests/support/fake.hpp"

namespace pelage {
namespace {

/// A subject whose frames take `ms` each. It adds its letter to `order`.
class Constant : public test::FakeSubject {
 public:
  Constant(double ms, char letter, std::string& order)
      : FakeSubject(ms), ms_(ms), letter_(letter), order_(order) {}
  FrameSample frame() override {
    order_ += letter_;
    return {.wall_ms = ms_, .cpu_ms = 2 * ms_};
  }

 private:
  double ms_;
  char letter_;
  std::string& order_;
};

/// Returns the row of frames of 10 ms in turns with "nest" (20 ms) and "twig" (5 ms), and the order of the
/// frames.
std::pair<Row, std::string> timed(TurnRules rules) {
  std::string order;
  rules.check = own_checks;
  const RunPlan plan = test::fake_plan(1);
  Row row = run_case(plan, plan.cases[0], {0, 6, 6, 1.0, 10}, [&](const Case&) {
    std::vector<Turn> others;
    others.push_back({"nest", std::make_unique<Constant>(20, 'n', order)});
    others.push_back({"twig", std::make_unique<Constant>(5, 't', order)});
    return std::make_unique<Turns>(std::make_unique<Constant>(10, 'f', order), std::move(others),
                                   std::move(rules));
  });
  return {row, order};
}

TEST(Turns, ARatioIsTheOtherTimeDividedByTheFrame) {
  const auto [row, order] = timed({});
  ASSERT_EQ(row.status, Status::ok) << row.reason;
  EXPECT_EQ(row.samples.at("frame").wall_ms, std::vector<double>(6, 10));
  EXPECT_EQ(row.samples.at("nest").wall_ms, std::vector<double>(6, 20));
  EXPECT_EQ(row.samples.at("twig").cpu_ms, std::vector<double>(6, 10));
  EXPECT_EQ(row.metrics.at("nest_ratio").value, 2);
  EXPECT_EQ(row.metrics.at("twig_ratio").value, 0.5);
  EXPECT_FALSE(row.metrics.contains("frame_over_nest"));
  EXPECT_EQ(row_from_line(to_line(row)).metrics.at("nest_ratio").value, 2) << "the reader agrees";
  EXPECT_EQ(order.substr(0, 6), "fntfnt");
}

TEST(Turns, TheInverseHasANameOfItsOwn) {
  const Row row = timed({.check = {}, .frame_over = true}).first;
  ASSERT_EQ(row.status, Status::ok) << row.reason;
  EXPECT_EQ(row.metrics.at("frame_over_nest").value, 0.5);
  EXPECT_EQ(row.metrics.at("frame_over_twig").value, 2);
  EXPECT_FALSE(row.metrics.contains("nest_ratio"));
  EXPECT_EQ(row_from_line(to_line(row)).metrics.at("frame_over_nest").value, 0.5);
}

TEST(Turns, TheFirstOfARoundChanges) {
  const auto [row, order] = timed({.check = {}, .rotate = true});
  EXPECT_EQ(order.substr(0, 9), "fntntftfn");
  EXPECT_EQ(row.metrics.at("nest_ratio").value, 2);
  EXPECT_EQ(row.samples.at("frame").wall_ms, std::vector<double>(6, 10));
}

TEST(Turns, TheChecksOfAllPicturesCount) {
  const Row row = timed({}).first;
  ASSERT_EQ(row.check.size(), 3u);
  EXPECT_EQ(row.check[1].against, "reference, nest");
}

}  // namespace
}  // namespace pelage
