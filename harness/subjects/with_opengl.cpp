#include "harness/subjects/with_opengl.hpp"

#include "harness/compare/checks.hpp"
#include "harness/measure/turns.hpp"

namespace pelage {
namespace {

std::vector<Check> same_picture(const Turn& other, const Picture& timed) {
  return other_filter_checks(other.name, compare(timed, other.subject->read()));
}

void describe_baseline(const Turn& other, Row& row) {
  Row theirs;
  other.subject->describe(theirs);
  row.metrics[other.name + "_build_ms"] = {theirs.build_ms, "ms"};
  for (const auto& [key, value] : theirs.provenance.items())
    if (!row.provenance.contains(key)) row.provenance[key] = value;
  row.identity.insert(theirs.identity.begin(), theirs.identity.end());
}

}  // namespace

std::unique_ptr<Subject> with_opengl(std::unique_ptr<Subject> ours, std::unique_ptr<Subject> theirs) {
  std::vector<Turn> others;
  others.push_back({"opengl", std::move(theirs)});
  return std::make_unique<Turns>(std::move(ours), std::move(others),
                                 TurnRules{.check = same_picture, .describe = describe_baseline});
}

}  // namespace pelage
