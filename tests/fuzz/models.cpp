#include "harness/mesh/models.hpp"

#include "tests/fuzz/support.hpp"
#include "tests/fuzz/targets.hpp"

namespace pelage::fuzz {

void models(std::string_view bytes) {
  const MemoryFile file(bytes);
  may_refuse([&] { read_models(file.path()); });
}

}  // namespace pelage::fuzz
