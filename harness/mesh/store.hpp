// Prepared meshes that stay in memory from case to case.
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "harness/mesh/mesh.hpp"

namespace pelage {

class MeshStore {
 public:
  /// `progress` is told what takes long.
  explicit MeshStore(std::function<void(const std::string&)> progress) : progress_(std::move(progress)) {}
  /// As load_model(); prepared once.
  std::shared_ptr<const Mesh> get(const std::string& model);

 private:
  std::function<void(const std::string&)> progress_;
  std::map<std::string, std::shared_ptr<const Mesh>> meshes_;
};

}  // namespace pelage
