// `pelage check` of strands: a time step of the chains and a picture against the reference.
#include <fmt/format.h>

#include "harness/hash.hpp"
#include "harness/strands/opencl/strands.hpp"
#include "harness/system/strands/backends.hpp"

namespace pelage::strands {
namespace {

constexpr int checked_frames = 30;  // number of simulated frames of 1/60 s each; the last one is drawn
constexpr int hashed_frames = 100;  // number of frames in one hash

}  // namespace

std::vector<StageCheck> check(const CheckRequest& request) {
  const auto backend = open_opencl({.device = request.device, .mapping = request.mapping}, request.scene);
  backend->load(prepare_strands(request.scene, request.mesh));
  backend->advance(checked_frames - 1);
  backend->frame();
  backend->begin_checks();
  std::vector<StageCheck> all;
  for (const Check& check : backend->checks(backend->read(), 1)) {
    const std::string stage = check.metric.starts_with("chain_") ? "chains" : "strands";
    if (request.wants(stage)) all.push_back({stage, check});
  }
  return all;
}

/// For each of three numbers of chunks, prints a hash of the key strands, the list of strands and the picture
/// of every frame of `hashed_frames` frames. All three hashes must be equal.
void hash(const CheckRequest& request,
          const std::function<void(const std::string&, const std::string&)>& print) {
  const auto input = prepare_strands(request.scene, request.mesh);
  for (const int chunks : {1, 16, 1024}) {
    DrawerOptions options;
    options.chunks = chunks;
    Strands strands(request.device, input, options);
    Hash hash;
    for (int frame = 0; frame < hashed_frames; ++frame) {
      strands.frame();
      hash.values(strands.keys()).values(strands.order()).values(strands.read().pixel);
    }
    print(fmt::format("{} frames of strands, {} chunks", hashed_frames, chunks), hash.hex());
  }
}

}  // namespace pelage::strands
