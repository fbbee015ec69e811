// The OpenGL baseline of pictures of strands (docs/strands.md, section Drawing). As in D, the host
// interpolates the strands, removes those that face away, sorts the others with a radix sort, and writes one
// record per strand into a vertex buffer. OpenGL expands each record to a strip and blends the strips from
// back to front. It runs on a GPU, or on the CPU with Mesa's llvmpipe.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "harness/picture/picture.hpp"
#include "harness/strands/drawing/drawing.hpp"
#include "harness/strands/drawing/keyed.hpp"

namespace pelage::strands {

/// Implementation choices of the baseline.
struct RibbonOptions {
  /// How OpenGL draws the strips. "instanced": each strand is an instance of a triangle strip. "indexed": all
  /// strips are one list of indexed triangles, and the vertex shader reads the strands from a buffer.
  std::string expand = "instanced";
  /// Framebuffer format: "rgba32f", "rgba16f" or "rgba8". With "rgba8" the picture is rounded to 8 bits after
  /// every strand.
  std::string target = "rgba32f";
  bool operator==(const RibbonOptions&) const = default;
};

/// Reads options such as "expand=indexed,target=rgba8". Options that are absent keep their defaults. Throws
/// InputError for an unknown name or value.
RibbonOptions ribbon_options(const std::string& text);

/// Returns all options as text that ribbon_options() reads.
std::string to_text(const RibbonOptions& options);

/// Strands that OpenGL draws. The member functions and the constructor throw DeviceError if OpenGL reports an
/// error. The constructor throws InputError if there is no OpenGL 4.5.
class Ribbons {
 public:
  Ribbons(const DrawingScene& scene, const std::vector<KeyedStrand>& strands,
          const RibbonOptions& options = {});
  ~Ribbons();
  Ribbons(Ribbons&&) noexcept;
  Ribbons& operator=(Ribbons&&) noexcept;

  /// Draws one frame from the key strands: interpolation, sort, upload, drawing and glFinish. Returns the
  /// wall time in ms.
  double frame(const std::vector<KeyStrand>& keys);
  Picture read() const;       ///< copies the picture of the last frame to the host
  std::size_t drawn() const;  ///< number of strands in the last picture

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pelage::strands
