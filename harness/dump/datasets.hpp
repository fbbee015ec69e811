// Functions that write the datasets of a dump (an HDF5 file with the data of one frame), one function per
// group of datasets. docs/dump.md lists the datasets.
#pragma once
#include <functional>
#include <type_traits>
#include <vector>

#include "harness/compare/frame_output.hpp"
#include "harness/picture/hdf5_file.hpp"

namespace pelage::dump {

/// Returns one value per element: `value` is a member or a function of the element.
template <class Element, class Value>
auto column(const std::vector<Element>& elements, const Value& value) {
  std::vector<std::remove_cvref_t<std::invoke_result_t<Value, const Element&>>> values;
  values.reserve(elements.size());
  for (const Element& element : elements) values.push_back(std::invoke(value, element));
  return values;
}

/// Writes the attributes of the file: versions, pipeline, number of frames, and hashes of mesh and scene.
void write_notes(Hdf5File& file, const Scene& scene, const Mesh& mesh, const std::string& pipeline,
                 int frames);
void write_scene_text(Hdf5File& file, const Scene& scene);
/// Writes positions, triangles, UVs and surface points of the mesh.
void write_shape(Hdf5File& file, const Mesh& mesh);
/// Writes the normals, the tangents and the frames of the curl.
void write_mesh(Hdf5File& file, const FrameInput& input);
void write_strands(Hdf5File& file, const FrameInput& input, const FrameOutput& output);
void write_wetness(Hdf5File& file, const FrameInput& input, const FrameOutput& output);
void write_textures(Hdf5File& file, const FrameInput& input);
void write_camera(Hdf5File& file, const Camera& camera);
/// Writes the factors of the scene's maps (docs/shells.md, section 8) and the distance field of the mesh
/// among its colliders (docs/shells.md, section 9). Writes nothing if the scene has none.
void write_style(Hdf5File& file, const FrameInput& input);

/// Writes the displacement of each vertex in each layer: its position in the layer minus its position on the
/// mesh. The double-precision reference computes the displacements from the scene's strands, or from
/// `output.tips` if a mass-spring topology moves the fur.
void write_layers(Hdf5File& file, const FrameInput& input, const FrameOutput& output);

}  // namespace pelage::dump
