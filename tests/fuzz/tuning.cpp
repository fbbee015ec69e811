#include "harness/tuning/tuning.hpp"

#include "tests/fuzz/support.hpp"
#include "tests/fuzz/targets.hpp"

namespace pelage::fuzz {

// `pelage tune` writes new values into an existing tuning file. If read_tuning() accepts the existing file,
// then read_tuning() must not crash on the file with the new values.
void tuning(std::string_view bytes) {
  const MemoryFile file(bytes);
  may_refuse([&] {
    read_tuning(file.path());
    const MemoryFile changed(with_stage(std::string(bytes), "wet", {}, "a note"));
    may_refuse([&] { read_tuning(changed.path()); });
  });
}

}  // namespace pelage::fuzz
