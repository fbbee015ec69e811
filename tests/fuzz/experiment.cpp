#include "harness/experiment/experiment.hpp"

#include "tests/fuzz/support.hpp"
#include "tests/fuzz/targets.hpp"

namespace pelage::fuzz {

void experiment(std::string_view bytes) {
  const MemoryFile file(bytes);
  may_refuse([&] {
    const Experiment read = read_experiment(file.path());
    for (const auto& named : read.presets)
      may_refuse([&] {
        const std::vector<Case> cases = cases_of(read, named.second);
        for (std::size_t i = 0; i < cases.size() && i < 4; ++i) may_refuse([&] { scene_of(read, cases[i]); });
      });
  });
}

}  // namespace pelage::fuzz
