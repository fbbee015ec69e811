#include "harness/shells/opencl/work.hpp"

#include "harness/shells/opencl/mapping.hpp"

namespace pelage::shells {
namespace {

double per_shaded(const RasterParams& p, double wet_share) {
  const int tables = 1 + (p.wet_model || p.substeps > 1) + (p.substeps > 1);
  double sum = operations::point + tables * operations::record + operations::square +
               operations::dry_fragment + wet_share * operations::clump;
  if (p.substeps > 1) sum += operations::substeps + (p.substeps - 1) * operations::substep;
  return sum;
}

double per_blended(const RasterParams& p) {
  return operations::blend + (p.wet_model ? operations::wet_colour + p.lights * operations::wet_light
                                          : operations::colour + p.lights * operations::light);
}

}  // namespace

std::map<std::string, double> frame_operations(const RasterParams& raster, const SimulateParams& simulate,
                                               const Geometry& geometry, const Tally& tally,
                                               double wet_share) {
  const double fragments =
      double(tally.shaded) * per_shaded(raster, wet_share) + double(tally.blended) * per_blended(raster);
  // The tile mapping computes the view direction once per pixel, the other mappings once per fragment.
  const double eye_per_pixel = double(raster.width) * raster.height * operations::eye;
  const double eye_per_fragment = double(tally.shaded) * operations::eye;
  return {{"strand_frame", double(simulate.stride) * simulate.substeps * operations::strand_substep},
          {"vertex_tips", double(geometry.weight.size()) * operations::tip_entry},
          {"layer_vertices", double(raster.vertices) * (raster.layers + 1) * operations::vertex_layer},
          {std::string(tile_mapping.kernel), fragments + eye_per_pixel},
          {std::string(pixel_mapping.kernel), fragments + eye_per_fragment},
          {std::string(workgroup_mapping.kernel), fragments + eye_per_fragment}};
}

}  // namespace pelage::shells
