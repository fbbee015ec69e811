#include "harness/measure/precision.hpp"

#include "harness/measure/statistics.hpp"

namespace pelage {

bool is_precise(const Row& row) {
  const std::vector<double> times = frame_ms(row);
  const double asked = row.provenance.value("precision", 1.0);
  return has_median_interval(times.size()) &&
         relative_half_width(times) <= (asked < 1 ? asked : usual_precision);
}

}  // namespace pelage
