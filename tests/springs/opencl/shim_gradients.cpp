#include "tests/springs/opencl/shim.hpp"
// clang-format off: the next header must be the last one, because its macros would break other headers
#include "tests/springs/support/in_double.hpp"
// clang-format on

#define DOUBLE_SUMS 1
namespace pelage::gradients_in_double {
namespace {
using namespace in_double;
// clang-format off
#include "springs/gradients.cl"
// clang-format on
}  // namespace
}  // namespace pelage::gradients_in_double

namespace pelage::springs::test {

void gradients_substep(Memory& m, int substep, double residual) {
  namespace kernels = gradients_in_double;
  const Layout& l = *m.layout;
  const int chunks = 16 * l.slices;
  const std::size_t places = l.places();
  std::vector<double> diagonal(6 * places), inverse(6 * places), coupling(3 * l.neighbour.size()),
      r(3 * places), d(4 * places), product(3 * places), sums(std::size_t(SUM_ROWS * chunks));
  const auto each = [&](const auto& kernel) {
    for (in_double::work_item = 0; in_double::work_item < chunks; ++in_double::work_item) kernel();
  };
  const auto sum = [&](int row) {
    double total = 0;
    for (int k = 0; k < chunks; ++k) total += sums[std::size_t(row) * std::size_t(chunks) + std::size_t(k)];
    return total;
  };
  each([&] {
    kernels::gradients_set_up(m.params, chunks, 2 * substep + 2, m.moments.data(), m.sites.data(),
                              m.push.data(), l.start.data(), l.neighbour.data(), m.rest.data(), m.root.data(),
                              m.reach.data(), m.speed.data(), m.change.data(), diagonal.data(),
                              inverse.data(), coupling.data(), r.data(), d.data(), sums.data());
  });
  int done = 0;
  while (sum(SUM_RR) > residual * residual * sum(SUM_BB) && done < 1000) {
    const int odd = done++ % 2;
    each([&] {
      kernels::gradients_product(m.params, chunks, l.start.data(), l.neighbour.data(), diagonal.data(),
                                 coupling.data(), d.data(), product.data(), sums.data());
    });
    each([&] {
      kernels::gradients_advance(m.params, chunks, odd, inverse.data(), product.data(), r.data(),
                                 sums.data());
    });
    each([&] {
      kernels::gradients_turn(m.params, chunks, odd, product.data(), d.data(), m.change.data(), sums.data());
    });
  }
  each([&] {
    kernels::gradients_move(m.params, chunks, m.params.first_step + substep, m.change.data(), m.offset.data(),
                            m.speed.data(), m.reach.data(), m.diverged_at.data(), m.first.data());
  });
}

void gradients_whole(Memory& m, double residual) {
  const Layout& l = *m.layout;
  const std::size_t places = l.places();
  std::vector<double> diagonal(6 * places), inverse(6 * places), coupling(3 * l.neighbour.size()),
      r(3 * places), d(4 * places), product(3 * places), sums(SUM_ROWS), solved(3);
  TopologyParams params = m.params;
  params.blocks_per_item = 16 * l.slices;
  in_double::work_item = 0;
  gradients_in_double::gradients_whole(
      params, 1000, residual, m.moments.data(), m.sites.data(), m.push.data(), l.start.data(),
      l.neighbour.data(), m.rest.data(), m.root.data(), m.reach.data(), m.offset.data(), m.speed.data(),
      m.change.data(), diagonal.data(), inverse.data(), coupling.data(), r.data(), d.data(), product.data(),
      sums.data(), m.diverged_at.data(), m.first.data(), solved.data());
}

}  // namespace pelage::springs::test
