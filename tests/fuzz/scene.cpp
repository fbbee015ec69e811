#include "harness/scene/scene_toml.hpp"
#include "tests/fuzz/support.hpp"
#include "tests/fuzz/targets.hpp"

namespace pelage::fuzz {

// write_scene() must write every accepted scene such that parse_scene() reads the same scene from it.
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

}  // namespace pelage::fuzz
