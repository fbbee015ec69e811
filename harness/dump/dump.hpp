// Writes all inputs and intermediate results of a frame to an HDF5 file, so that another program can check
// each stage. docs/dump.md lists the datasets.
#pragma once
#include <filesystem>
#include <functional>
#include <type_traits>
#include <vector>

#include "harness/compare/frame_output.hpp"
#include "harness/compare/strands.hpp"
#include "harness/picture/hdf5_file.hpp"

namespace pelage {

/// What every dump of a frame contains.
struct DumpedFrame {
  const Scene& scene;
  const Mesh& mesh;
  const Picture& picture;
  std::string title;  ///< names the pipeline that computed the frame
  int frames = 0;     ///< number of frames simulated from rest
};

/// Writes the datasets of docs/dump.md as HDF5, each with the attributes "units" and "description". `arrays`
/// writes the datasets of the system that drew the frame. If writing fails, no partial file remains. Throws
/// InputError if the file cannot be written.
void write_dump(const std::filesystem::path& path, const DumpedFrame& frame,
                const std::function<void(Hdf5File&)>& arrays);

/// Throws InputError if `path` does not end in .h5 or .hdf5, or if its folder does not exist. Call this
/// function before the frame is computed, so that a bad path is reported early.
void check_dump_path(const std::filesystem::path& path);

namespace dump {

/// Writes the arrays of a frame of shells. `output` holds its tips, velocities and mask.
void write_shells(Hdf5File& file, const FrameInput& input, const FrameOutput& output);

/// Writes the arrays of a picture of strands (docs/dump.md, section Strands).
void write_strand_frame(Hdf5File& file, const strands::StrandInput& input, const StrandFrame& frame);

}  // namespace dump

}  // namespace pelage

namespace pelage::dump {
/// Returns one value per element: `value` is a member or a function of the element.
template <class Element, class Value>
auto column(const std::vector<Element>& elements, const Value& value) {
  std::vector<std::remove_cvref_t<std::invoke_result_t<Value, const Element&>>> values;
  values.reserve(elements.size());
  for (const Element& element : elements) values.push_back(std::invoke(value, element));
  return values;
}

void write_camera(Hdf5File& file, const Camera& camera);
}  // namespace pelage::dump
