#include <assimp/BaseImporter.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <string_view>

#include "harness/error.hpp"
#include "harness/mesh/soup.hpp"

namespace pelage::detail {
namespace {

// Unregisters all importers of Assimp except OBJ, PLY, 3DS and glTF. Assimp has about fifty importers, and
// several of them had security holes recently.
void allow_only_known_formats(Assimp::Importer& importer) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    const aiImporterDesc* about = importer.GetImporterInfo(i);
    const std::string_view endings = about ? about->mFileExtensions : "";
    const bool known =
        endings == "obj" || endings == "ply" || endings.starts_with("3ds") || endings.starts_with("gltf");
    if (!known) importer.UnregisterLoader(importer.GetImporter(i));
  }
}

void append(const aiMesh& mesh, Soup& soup) {
  const auto first = std::uint32_t(soup.point.size());
  for (unsigned i = 0; i < mesh.mNumVertices; ++i)
    soup.point.emplace_back(mesh.mVertices[i].x, mesh.mVertices[i].y, mesh.mVertices[i].z);
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    if (face.mNumIndices != 3) continue;  // points and lines
    soup.polygon.emplace_back();
    if (mesh.HasTextureCoords(0)) soup.uv.emplace_back();
    for (unsigned k = 0; k < 3; ++k) {
      soup.polygon.back().push_back(first + face.mIndices[k]);
      if (!mesh.HasTextureCoords(0) || face.mIndices[k] >= mesh.mNumVertices) continue;
      const aiVector3D& uv = mesh.mTextureCoords[0][face.mIndices[k]];
      soup.uv.back().emplace_back(uv.x, uv.y);
    }
  }
}

}  // namespace

Soup read_by_assimp(const std::filesystem::path& file) {
  Assimp::Importer importer;
  allow_only_known_formats(importer);
  const aiScene* scene =
      importer.ReadFile(file.string(), aiProcess_Triangulate | aiProcess_PreTransformVertices |
                                           aiProcess_ValidateDataStructure);
  if (!scene) {
    std::string reason = importer.GetErrorString();
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    throw InputError(fmt::format("{}: not readable: {}", file.string(), reason));
  }
  Soup soup;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) append(*scene->mMeshes[i], soup);
  if (soup.uv.size() != soup.polygon.size()) soup.uv.clear();  // some meshes of the file have no UV map
  return soup;
}

}  // namespace pelage::detail
