#include "harness/scene/scene_toml.hpp"
#include "tests/fuzz/support.hpp"
#include "tests/fuzz/targets.hpp"

namespace pelage::fuzz {

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

}  // namespace pelage::fuzz
