#include "harness/shells/opencl/work.hpp"

#include "harness/shells/opencl/mapping.hpp"

namespace pelage::shells {
namespace {

double per_shaded(const RasterParams& p, double wet_share) {
  const int tables = 1 + (p.surface_light || p.substeps > 1) + (p.substeps > 1);
  double sum =
      operations::point + tables * operations::record + operations::square + operations::dry_fragment +
      wet_share * (p.clump_cells == CELLS_CONSISTENT ? operations::consistent_clump : operations::clump);
  if (p.substeps > 1) sum += operations::substeps + (p.substeps - 1) * operations::substep;
  return sum;
}

double per_blended(const RasterParams& p) {
  return operations::blend + (p.surface_light ? operations::wet_colour + p.lights * operations::wet_light
                                              : operations::colour + p.lights * operations::light);
}

}  // namespace

std::map<std::string, double> frame_operations(const RasterParams& raster, const SimulateParams& simulate,
                                               const Geometry& geometry, const Tally& tally,
                                               double wet_share) {
  const double fragments =
      double(tally.shaded) * per_shaded(raster, wet_share) + double(tally.blended) * per_blended(raster);
  std::map<std::string, double> per_kernel{
      {"strand_frame", double(simulate.stride) * simulate.substeps * operations::strand_substep},
      {"vertex_tips", double(geometry.weight.size()) * operations::tip_entry},
      {"layer_vertices", double(raster.vertices) * (raster.layers + 1) * operations::vertex_layer},
  };
  for (const MappingKind* mapping : mapping_kinds) {
    const double rays =
        mapping->one_eye_per_pixel ? double(raster.width) * raster.height : double(tally.shaded);
    per_kernel[std::string(mapping->kernel)] = fragments + rays * operations::eye;
  }
  return per_kernel;
}

}  // namespace pelage::shells
