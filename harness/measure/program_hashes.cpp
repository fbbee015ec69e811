#include "harness/measure/program_hashes.hpp"

#include "harness/hash.hpp"
#include "harness/version/version.hpp"

namespace pelage {

void add_programs(Identity& identity, const std::vector<const cl::Program*>& programs) {
  for (const auto& [file, hash] : cl::hashes_by_file(programs)) identity[kernel_part + file] = hash;
}

std::string build_hash() {
  const BuildInfo& build = build_info();
  return Hash().text(build.compiler).text(build.flags).hex();
}

}  // namespace pelage
