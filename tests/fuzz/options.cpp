#include <algorithm>

#include "harness/cl/device.hpp"
#include "harness/experiment/axes.hpp"
#include "harness/experiment/experiment.hpp"
#include "harness/measure/cpu_use.hpp"
#include "harness/record/results_folder.hpp"
#include "harness/report/comparison.hpp"
#include "harness/shells/opengl/opengl.hpp"
#include "tests/fuzz/support.hpp"
#include "tests/fuzz/targets.hpp"

namespace pelage::fuzz {

// The first line of the input is the value of an option. The rest is used as the name of a case or of a
// device.
void options(std::string_view bytes) {
  const std::size_t end = std::min(bytes.find('\n'), bytes.size());
  const std::string first(bytes.substr(0, end)), second(bytes.substr(std::min(end + 1, bytes.size())));
  may_refuse([&] { Filter(first).finds(second); });
  may_refuse([&] {
    const Shard shard = shard_from_text(first);
    expect(shard.index >= 0 && shard.index < shard.count, "a shard out of range");
  });
  may_refuse([&] { expect(fraction_from_text("--threshold", first) >= 0, "a negative threshold"); });
  may_refuse([&] { CompareBy by(first); });
  may_refuse([&] {
    const Metric figure = published_figure(first, "ms");
    expect(!figure.low || !figure.high || *figure.low <= *figure.high, "a published range without values");
  });
  may_refuse([&] {
    const std::string text = to_text(opengl_options(first));
    expect(to_text(opengl_options(text)) == text, "the written OpenGL options are other options");
  });
  may_refuse([&] {
    cl::DeviceInfo device;
    device.name = second;
    device.platform = "Portable Computing Language";
    cl::choose({device, device}, first, "--device");
  });
  canonical(first);
  const JournalName name = journal_name(first + ".jsonl");
  expect(name.index >= 0 && name.index < name.count, "the name of a journal with a shard out of range");
}

void proc_stat(std::string_view bytes) {
  const auto before = machine_time(std::string(bytes), 100);
  if (!before) return;
  if (const auto share = other_share({0.1, 0}, *before))
    expect(*share >= 0 && *share <= 1, "a share of CPU time that is not a fraction");
}

}  // namespace pelage::fuzz
