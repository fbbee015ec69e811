// Strands by the OpenGL baseline (harness/strands/opengl/ribbons.hpp). The reference simulates the key
// strands, unless show_keys() gives them.
#include <fmt/format.h>

#include <optional>

#include "harness/strands/opengl/ribbons.hpp"
#include "harness/system/backend_parts.hpp"
#include "harness/system/strands/backends.hpp"

namespace pelage::strands {
namespace {

void need_still_skin(const StrandInput& input) {
  if (input.skin && !input.mesh->frames.empty())
    throw CannotDraw(
        "the OpenGL baseline draws a skin that does not deform: set mesh.frames = 1, or strands.skin = false");
}

class StrandsInOpenGl : public InOpenGl<StrandInput, RibbonOptions> {
 public:
  using InOpenGl::InOpenGl;

  void load(const SystemInput& input) override {
    ribbons_.reset();
    input_ = own<StrandInput>(input);
    need_still_skin(*input_);
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
