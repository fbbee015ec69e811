// Strands by the OpenGL baseline (harness/strands/opengl/ribbons.hpp). The reference simulates the key
// strands, unless show_keys() gives them.
#include <fmt/format.h>

#include <optional>

#include "harness/strands/opengl/ribbons.hpp"
#include "harness/system/backend_parts.hpp"
#include "harness/system/strands/backends.hpp"

namespace pelage::strands {
namespace {

void need_what_is_drawn(const StrandInput& input) {
  const StrandsScene& s = input.scene.strands;
  if (!input.look.fills.empty() || s.rim != glm::vec3(0) || s.skin_shadow != 0 || s.shadow != "none" ||
      s.skin)
    throw CannotDraw(
        "the OpenGL baseline draws strands with a key light and ambient light only: give one [[shading.light]], and set strands.skin_shadow = 0, strands.rim = [0, 0, 0], strands.shadow = \"none\", strands.skin = false");
  if (input.look.fraction < 1)
    throw CannotDraw(
        "the OpenGL baseline draws all strands: set strands.fraction = 1, strands.least_width = 0");
  for (const StrandLayerScene& layer : s.layers)
    if (layer.is_styled() || !layer.film.empty())
      throw CannotDraw(
          "the OpenGL baseline draws plain strands: set response = 1, twist = 0, twist_spread = 0, curvature = 0, curvature_spread = 0 and no film in each layer of [strands]");
}

class StrandsInOpenGl : public InOpenGl<StrandInput, RibbonOptions> {
 public:
  using InOpenGl::InOpenGl;

  void load(const SystemInput& input) override {
    ribbons_.reset();
    input_ = own<StrandInput>(input);
    need_what_is_drawn(*input_);
    frames_ = 0;
    prepared_ = false;
    ribbons_.emplace(*input_, input_->fur.strands, options_);
  }
  void show(std::vector<KeyStrand> keys) {
    keys_ = std::move(keys);
    given_ = true;
  }

  cl::FrameTiming still() override { return {ribbons_->frame(keys_), {}, {}}; }
  void advance(int frames) override { frames_ += frames; }
  Picture read() override { return ribbons_->read(); }
  void dump(Hdf5File& file, const Scene& scene) override {
    strands::dump(file, *input_, scene, {keys_, reference_curves(*input_, keys_), {}, {}});
  }

  std::vector<Check> checks(const Picture& timed, std::uint32_t) override {
    return other_filter_checks(against_reference,
                               compare(timed, reference_strands(*input_, keys_, input_->skin).picture));
  }
  std::string title() const override {
    return fmt::format("strands in OpenGL on {}, {}", renderer_, to_text(options_));
  }

 private:
  void simulate() override {
    ++frames_;
    if (!given_) keys_ = reference_keys(*input_, frames_).first;
  }

  std::optional<Ribbons> ribbons_;
  std::vector<KeyStrand> keys_;
  bool given_ = false;  ///< show() gave the keys
};

}  // namespace

void show_keys(Backend& opengl, std::vector<KeyStrand> keys) {
  dynamic_cast<StrandsInOpenGl&>(opengl).show(std::move(keys));
}

std::unique_ptr<Backend> open_opengl(const BackendOptions& options, const Scene&) {
  return std::make_unique<StrandsInOpenGl>(ribbon_options(options.opengl));
}

}  // namespace pelage::strands
