#include "harness/subjects/frames.hpp"

#include "harness/cl/program.hpp"
#include "harness/compare/metrics.hpp"
#include "harness/measure/cpu_use.hpp"
#include "harness/measure/provenance.hpp"
#include "harness/mesh/quality.hpp"
#include "harness/scene/scene_toml.hpp"
#include "harness/shells/opengl/opengl.hpp"
#include "harness/springs/opencl/mass_springs.hpp"

namespace pelage {
namespace {

template <class F>
void bounded(F&& move) {
  try {
    move();
  } catch (const springs::Diverged& error) {
    throw OutOfBounds(error.what());
  }
}

}  // namespace

Frames::Frames(SubjectContext& context, const Case& which, const KnownBackend& known, bool still)
    : scene_(scene_of(context.experiment, which)), still_(still), seed_(check_seed(which.name)) {
  BackendOptions options{.mapping = which.mapping, .opengl = which.opengl, .tuning = context.tuning};
  if (known.kind->on_device) options.device = context.device;
  try {
    backend_ = known.kind->open(options, scene_);
    mesh_ = context.mesh_of(scene_);
    reset_peak_memory();
    backend_->load(known.system->prepare(scene_, mesh_));
  } catch (const CannotDraw& error) {
    throw Unsupported(error.what());
  }
  bounded([&] { backend_->advance(frames_before(scene_.dynamics)); });
  backend_->begin_checks();
}

FrameSample Frames::frame() {
  if (!still_) backend_->prepare_frame();
  cl::FrameTiming timing;
  const Cost cost =
      cost_of([&] { bounded([&] { timing = still_ ? backend_->still() : backend_->frame(); }); });
  const FrameSample sample{
      .wall_ms = timing.wall_ms, .phase_event_ms = timing.phase_event_ms, .cpu_ms = cost.cpu_ms};
  simulated_.add(sample);
  return sample;
}

Picture Frames::read() {
  return backend_->read();
}

std::vector<Check> Frames::check(const Picture& timed) {
  peak_ = peak_memory();  // read before the reference allocates memory
  return backend_->checks(timed, seed_);
}

void Frames::describe(Row& row) {
  Description found;
  backend_->describe(found);
  for (const auto& [name, value] : found.metrics) row.metrics[name] = {value.first, value.second};
  row.build_ms = backend_->build_ms();
  row.tuning = found.tuning;
  row.metrics["triangles"] = {double(mesh_->triangle.size()), "triangles"};
  row.metrics["model_height"] = {model_height(backend_->read()), "1"};
  row.metrics["frames_simulated"] = {double(backend_->frames_simulated()), "frames"};
  simulated_.describe(row, backend_->segments());
  if (const auto programs = backend_->programs(); !programs.empty()) {
    // The memory of other backends is mostly that of the reference.
    if (peak_ > 0) row.metrics["peak_memory"] = {double(peak_), "bytes"};
    add_programs(row.identity, programs);
    row.provenance["kernel_hash"] = cl::hash_of(programs);
  }
  row.provenance["mesh_hash"] = mesh_->hash;
  row.provenance["mesh_warnings"] = mesh_warnings(*mesh_);
  row.provenance["scene_hash"] = scene_hash(scene_);
  row.provenance["check_seed"] = seed_;
  if (found.opengl_renderer.empty()) return;
  row.provenance["opengl_renderer"] = found.opengl_renderer;
  row.identity[renderer_part] = renderer_hash(found.opengl_renderer);
  row.provenance["opengl_options"] = found.opengl_options;
  row.provenance["shader_hash"] = row.identity[shader_part] = shader_hash();
}

}  // namespace pelage
