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
#include "harness/mesh/read/formats.hpp"

namespace pelage::detail {
namespace {

// Unregisters all importers of Assimp except that of 3DS. Assimp has about fifty importers, and several of
// them had security holes recently.
void allow_only_3ds(Assimp::Importer& importer) {
  for (std::size_t i = importer.GetImporterCount(); i--;) {
    const aiImporterDesc* about = importer.GetImporterInfo(i);
    const std::string_view endings = about ? about->mFileExtensions : "";
    if (!endings.starts_with("3ds")) importer.UnregisterLoader(importer.GetImporter(i));
  }
}

void append(const aiMesh& mesh, bool with_uv, Soup& soup) {
  const bool has_uv = with_uv && mesh.HasTextureCoords(0);
  const auto first = std::uint32_t(soup.point.size());
  for (const aiVector3D& p : std::span(mesh.mVertices, mesh.mNumVertices))
    soup.point.emplace_back(p.x, p.y, p.z);
  for (const aiFace& face : std::span(mesh.mFaces, mesh.mNumFaces)) {
    if (face.mNumIndices != 3) continue;  // points and lines
    soup.polygon.emplace_back();
    soup.uv.emplace_back();
    for (const unsigned i : std::span(face.mIndices, face.mNumIndices)) {
      soup.polygon.back().push_back(first + i);
      if (!has_uv || i >= mesh.mNumVertices) continue;
      soup.uv.back().emplace_back(mesh.mTextureCoords[0][i].x, mesh.mTextureCoords[0][i].y);
    }
  }
}

}  // namespace

Soup read_3ds(const std::filesystem::path& file, bool with_uv) {
  Assimp::Importer importer;
  allow_only_3ds(importer);
  const aiScene* scene =
      importer.ReadFile(file.string(), aiProcess_Triangulate | aiProcess_PreTransformVertices |
                                           aiProcess_ValidateDataStructure);
  if (!scene) {
    std::string reason = importer.GetErrorString();
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    throw InputError(fmt::format("{}: not readable: {}", file.string(), reason));
  }
  Soup soup;
  for (const aiMesh* mesh : std::span(scene->mMeshes, scene->mNumMeshes)) append(*mesh, with_uv, soup);
  if (std::ranges::all_of(soup.uv, [](const auto& uv) { return uv.empty(); })) soup.uv.clear();
  return soup;
}

}  // namespace pelage::detail
