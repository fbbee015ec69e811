#include <assimp/BaseImporter.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <span>
#include <string_view>

#include "harness/error.hpp"
#include "harness/mesh/soup.hpp"

namespace pelage::detail {
namespace {

// Unregisters all importers of Assimp except OBJ, PLY, 3DS and glTF. Assimp has about fifty importers, and
// several of them had security holes recently.
void allow_only_known_formats(Assimp::Importer& importer) {
  for (std::size_t i = importer.GetImporterCount(); i--;) {
    const aiImporterDesc* about = importer.GetImporterInfo(i);
    const std::string_view endings = about ? about->mFileExtensions : "";
    const bool known =
        endings == "obj" || endings == "ply" || endings.starts_with("3ds") || endings.starts_with("gltf");
    if (!known) importer.UnregisterLoader(importer.GetImporter(i));
  }
}

void append(const aiMesh& mesh, Soup& soup) {
  const auto first = std::uint32_t(soup.point.size());
  for (const aiVector3D& p : std::span(mesh.mVertices, mesh.mNumVertices))
    soup.point.emplace_back(p.x, p.y, p.z);
  for (const aiFace& face : std::span(mesh.mFaces, mesh.mNumFaces)) {
    if (face.mNumIndices != 3) continue;  // points and lines
    soup.polygon.emplace_back();
    if (mesh.HasTextureCoords(0)) soup.uv.emplace_back();
    for (const unsigned i : std::span(face.mIndices, face.mNumIndices)) {
      soup.polygon.back().push_back(first + i);
      if (!mesh.HasTextureCoords(0) || i >= mesh.mNumVertices) continue;
      soup.uv.back().emplace_back(mesh.mTextureCoords[0][i].x, mesh.mTextureCoords[0][i].y);
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
  for (const aiMesh* mesh : std::span(scene->mMeshes, scene->mNumMeshes)) append(*mesh, soup);
  if (soup.uv.size() != soup.polygon.size()) soup.uv.clear();  // some meshes of the file have no UV map
  return soup;
}

}  // namespace pelage::detail
