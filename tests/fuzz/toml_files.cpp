// The targets that read TOML: scenes, experiments, models, claims and tuning files.
#include "harness/claims/claim.hpp"
#include "harness/experiment/experiment.hpp"
#include "harness/mesh/models.hpp"
#include "harness/scene/scene_toml.hpp"
#include "harness/tuning/tuning.hpp"
#include "tests/fuzz/support.hpp"
#include "tests/fuzz/targets.hpp"

namespace pelage::fuzz {

void claims(std::string_view bytes) {
  const MemoryFile file(bytes);
  may_refuse([&] { pelage::claims::read_claims(file.path()); });
}

void experiment(std::string_view bytes) {
  const MemoryFile file(bytes);
  may_refuse([&] {
    const Experiment read = read_experiment(file.path());
    for (const auto& named : read.presets)
      may_refuse([&] {
        const std::vector<Case> cases = cases_of(read, named.second);
        for (std::size_t i = 0; i < cases.size() && i < 4; ++i) may_refuse([&] { scene_of(read, cases[i]); });
      });
  });
}

void models(std::string_view bytes) {
  const MemoryFile file(bytes);
  may_refuse([&] { read_models(file.path()); });
}

// If parse_scene() accepts the input, write_scene() must write a text from which parse_scene() reads the same
// scene.
void scene(std::string_view bytes) {
  may_refuse([&] {
    const std::string written = write_scene(parse_scene(bytes, "scene.toml", "/nowhere"));
    expect(write_scene(parse_scene(written, "written.toml", "/nowhere")) == written,
           "the written scene is another scene");
  });
}

void set(std::string_view bytes) {
  may_refuse([&] {
    Scene scene;
    apply_set(scene, bytes);
    check_scene(scene);
  });
}

// `pelage tune` writes new values into an existing tuning file. If read_tuning() accepts the existing file,
// then read_tuning() must not crash on the file with the new values.
void tuning(std::string_view bytes) {
  const MemoryFile file(bytes);
  may_refuse([&] {
    read_tuning(file.path());
    const MemoryFile changed(with_stage(std::string(bytes), "wet", {}, "a note"));
    may_refuse([&] { read_tuning(changed.path()); });
  });
}

}  // namespace pelage::fuzz
