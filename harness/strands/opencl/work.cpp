#include "harness/strands/opencl/work.hpp"

namespace pelage::strands {

std::map<PhaseKernel, double> frame_operations(const StrandWork& w) {
  namespace cost = operations;
  const double interpolated = double(w.strands) * (cost::between_keys + (w.styles ? cost::style : 0));
  const double strip = double(w.segments + 1), shadow = w.shadow ? cost::shadow : 0;
  const double vertex = (w.lights ? cost::lit_vertex : cost::vertex) + shadow;
  const double raster =
      double(w.listed) * (strip * vertex + w.segments * cost::segment) + w.fragments * cost::fragment;
  const double map = double(w.map_listed) * (strip * cost::map_vertex + w.segments * cost::segment);
  const double skin = double(w.skin_pixels) * cost::skin_pixel;
  std::map<PhaseKernel, double> all{
      {{"simulate", "chain_frame"}, double(w.keys) * w.substeps * cost::chain_step},
      {{"keys", "strand_keys"}, interpolated + (w.lights ? double(w.drawn) * cost::steady_light : 0)},
      {{"raster", "strand_tiles"}, raster},
      {{"raster", "strand_group"}, raster}};
  if (w.shadow) {
    all[{"shadow", "strand_keys"}] = interpolated;
    all[{"shadow", "strand_tiles"}] = all[{"shadow", "strand_group"}] = map;
  }
  if (w.skin_vertices > 0) {
    all[{"skin", "skin_vertices"}] = double(w.skin_vertices) * (cost::skin_vertex + shadow);
    for (const char* kernel : {"skin_depth", "skin_owner", "skin_colours"}) all[{"skin", kernel}] = skin;
  }
  return all;
}

}  // namespace pelage::strands
