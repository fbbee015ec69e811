// Fur as shells: the table of its backends, and the reference renderer as one of them.
#include "harness/dump/dump.hpp"
#include "harness/prepare/moving_skin.hpp"
#include "harness/prepare/prepare.hpp"
#include "harness/shells/opencl/shells.hpp"
#include "harness/system/backend_parts.hpp"
#include "harness/system/shells/backends.hpp"

namespace pelage {
namespace shells {
namespace {

/// The reference renderer in double precision.
class Reference : public FromRest<FrameInput> {
 public:
  explicit Reference(bool eight_bits) : eight_bits_(eight_bits) {}
  Picture read() override { return output_.image; }
  void dump(Hdf5File& file, const Scene& scene) override {
    shells::dump(file, *with_skin(input_, frames_ - 1), scene, output_);
  }
  std::string title() const override { return output_.pipeline; }

 private:
  void draw() override { output_ = reference_output(*input_, frames_, eight_bits_); }

  bool eight_bits_;
  FrameOutput output_;
};

constexpr BackendKind backends[] = {
    {.name = "shells", .open = open_opencl, .on_device = true},
    {.name = "reference",
     .open = [](const BackendOptions& options, const Scene&) -> std::unique_ptr<Backend> {
       return std::make_unique<Reference>(options.bits == 8);
     },
     .rounds = true},
    {.name = "opengl", .open = open_opengl, .has_variants = true},
};
constexpr std::string_view stages[] = {"simulate", "mask", "picture", "mappings"};

SystemInput changed_view(const SystemInput& input, const Scene& scene) {
  const FrameInput& frame = *own<FrameInput>(input);
  return with_view(frame, scene, framed_points(frame));
}

}  // namespace

void dump(Hdf5File& file, FrameInput input, const Scene& scene, const FrameOutput& output) {
  input.scene = scene;
  dump::write_shells(file, input, output);
}

}  // namespace shells

extern const System shells_system{
    .name = "shells",
    .prepare = [](const Scene& scene, const std::shared_ptr<const Mesh>& mesh) -> SystemInput {
      return prepare(scene, mesh, Deforming::followed);
    },
    .is_view_key = is_view_key,
    .with_view = shells::changed_view,
    .backends = shells::backends,
    .stages = shells::stages,
    .check = shells::check,
    .hash = shells::hash,
    .mappings = mappings_on};

}  // namespace pelage
