// Replaces the sources of harness/strands/opengl if CMake did not find libepoxy.
#include "harness/strands/opengl/ribbons.hpp"

#include "harness/error.hpp"

namespace pelage::strands {
namespace {

[[noreturn]] void refuse() {
  throw InputError(
      "there is no OpenGL in this build: install libepoxy-dev (Debian), configure and build again");
}

}  // namespace

struct Ribbons::State {};

Ribbons::Ribbons(const RibbonScene&, const std::vector<KeyedStrand>&, const RibbonOptions&) {
  refuse();
}
Ribbons::~Ribbons() = default;
Ribbons::Ribbons(Ribbons&&) noexcept = default;
Ribbons& Ribbons::operator=(Ribbons&&) noexcept = default;
double Ribbons::frame(const std::vector<KeyStrand>&) {
  refuse();
}
Picture Ribbons::read() const {
  refuse();
}
std::size_t Ribbons::drawn() const {
  refuse();
}

}  // namespace pelage::strands
