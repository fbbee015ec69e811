// Fur of single strands: the table of its backends, and the reference as one of them.
#include "harness/dump/dump.hpp"
#include "harness/system/backend_parts.hpp"
#include "harness/system/strands/backends.hpp"

namespace pelage {
namespace strands {
namespace {

/// The reference in double precision.
class Reference : public FromRest<StrandInput> {
 public:
  Picture read() override { return frame_.picture; }
  void dump(Hdf5File& file, const Scene& scene) override { strands::dump(file, *input_, scene, frame_); }
  std::string title() const override { return "strands-reference"; }

 private:
  void draw() override { frame_ = reference_strands(*input_, frames_); }

  StrandFrame frame_;
};

constexpr BackendKind backends[] = {
    {.name = "strands", .open = open_opencl, .on_device = true},
    {.name = "strands-reference",
     .open = [](const BackendOptions&, const Scene&) -> std::unique_ptr<Backend> {
       return std::make_unique<Reference>();
     }},
    {.name = "strands-raycast", .open = open_raycast},
    {.name = "strands-opengl", .open = open_opengl, .has_variants = true},
};
constexpr std::string_view stages[] = {"chains", "strands"};

std::vector<std::string> mappings_of(const cl::DeviceInfo& device) {
  std::vector<std::string> names{std::string(cl::tile_mapping), std::string(cl::group_mapping)};
  if (!device.cpu) std::swap(names[0], names[1]);
  return names;
}

}  // namespace

void dump(Hdf5File& file, StrandInput input, const Scene& scene, const StrandFrame& frame) {
  input.scene = scene;
  dump::write_strand_frame(file, input, frame);
}

}  // namespace strands

extern const System strands_system{
    .name = "strands",
    .prepare = [](const Scene& scene, const std::shared_ptr<const Mesh>& mesh) -> SystemInput {
      return strands::prepare_strands(scene, mesh);
    },
    .is_view_key = strands::is_view_key,
    .with_view = [](const SystemInput& input, const Scene& scene) -> SystemInput {
      return strands::with_view(*own<strands::StrandInput>(input), scene);
    },
    .backends = strands::backends,
    .stages = strands::stages,
    .check = strands::check,
    .hash = strands::hash,
    .mappings = strands::mappings_of};

}  // namespace pelage
