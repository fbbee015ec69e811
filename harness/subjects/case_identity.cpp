#include "harness/subjects/case_identity.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/cl/program.hpp"
#include "harness/error.hpp"
#include "harness/hash.hpp"
#include "harness/measure/provenance.hpp"
#include "harness/scene/scene_toml.hpp"
#include "harness/shells/opengl/opengl.hpp"
#include "harness/subjects/in_turns.hpp"

namespace pelage {
namespace {

std::string hash(const std::string& text) {
  return Hash().text(text).hex();
}

/// Every number has its shortest decimal form, so that equal limits have equal texts.
std::string text_of(const SamplingLimits& l) {
  return fmt::format("{} {} {} {} {}", l.warm_up_s, l.least, l.most, l.precision, l.limit_s);
}

/// Returns the hash of this machine's OpenGL renderer, or "absent" if OpenGL is not available.
std::string present_renderer() {
  static const std::string known = [] {
    try {
      return renderer_hash(opengl_renderer());
    } catch (const InputError&) {
      return std::string("absent");
    }
  }();
  return known;
}

}  // namespace

Identity case_identity(SubjectContext& context, const Case& which, const SamplingLimits& limits) {
  const Scene scene = scene_of(context.experiment, which);
  Identity identity{{"scene", scene_hash(scene)},
                    {"mesh", context.mesh_of(scene)->hash},
                    {"variant", Hash().text(which.pipeline).text(which.mapping).text(which.opengl).hex()},
                    {"tuning", tuning_hash(context.tuning)},
                    {"sampling", hash(text_of(limits))},
                    {"device", device_hash(device_provenance(context.device.info()))},
                    {build_part, build_hash()}};
  if (which.pipeline.ends_with(control_suffix))
    identity["baseline"] = scene_hash(scene_of(context.experiment, control_case(context.experiment, which)));
  return identity;
}

Identity present_identity(Identity planned, const Identity& recorded) {
  const std::string prefix = kernel_part;
  for (const auto& [part, unused] : recorded) {
    if (part == shader_part) planned[part] = shader_hash();
    if (part == renderer_part) planned[part] = present_renderer();
    if (!part.starts_with(prefix)) continue;
    try {
      planned[part] = cl::hash_of(cl::sources_of(part.substr(prefix.size())));
    } catch (const InputError&) {  // The program's source file is missing. `planned` has no hash for this
                                   // program, and therefore differs from `recorded`.
    }
  }
  return planned;
}

void refuse_other_inputs(const std::string& file, const std::vector<KeptRow>& kept,
                         const std::function<Identity(const Case&)>& identity) {
  for (const auto& [row, which] : kept) {
    if (row->identity.empty())
      throw InputError(fmt::format(
          "{}: an older version of pelage wrote the row of {}; the row does not record the inputs of the measurement; give a new folder with -o",
          file, row->case_name));
    const Identity now = present_identity(identity(*which), row->identity);
    if (const std::vector<std::string> texts = differences(row->identity, now); !texts.empty())
      throw InputError(fmt::format(
          "{}: the recorded row of {} measured something else: {}; restore the recorded inputs, or give a new folder with -o",
          file, row->case_name, fmt::join(texts, "; ")));
  }
}

}  // namespace pelage
