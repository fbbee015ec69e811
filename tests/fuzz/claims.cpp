#include "harness/claims/claim.hpp"
#include "tests/fuzz/support.hpp"
#include "tests/fuzz/targets.hpp"

namespace pelage::fuzz {

void claims(std::string_view bytes) {
  const MemoryFile file(bytes);
  may_refuse([&] { pelage::claims::read_claims(file.path()); });
}

}  // namespace pelage::fuzz
