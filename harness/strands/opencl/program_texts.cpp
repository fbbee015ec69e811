#include "harness/strands/opencl/program_texts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "harness/cl/radix_sort.hpp"
#include "harness/contact/opencl/contact_stage.hpp"
#include "harness/error.hpp"
#include "harness/scene/scene_keys.hpp"
#include "harness/strands/scene/strand_input.hpp"
#include "kernels/strands/draw/params.h"

namespace pelage::strands {
namespace {

constexpr int item_map_tile = 64, group_map_tile = 16;

int tile_lanes_of(int wanted) {
  if (wanted != 0 && wanted != 8 && wanted != 16)
    throw InputError(fmt::format("tile_lanes: {}; it must be 8 or 16", wanted));
  return wanted == 0 ? 16 : wanted;
}

int tile_of(const cl::DeviceInfo& device, int width, int height, bool group, int wanted) {
  if (wanted != 0 && wanted != 16 && wanted != 32 && wanted != 64 && wanted != 128)
    throw InputError(fmt::format("tile: {} pixels; it must be 16, 32, 64 or 128", wanted));
  if (group && wanted > 16)
    throw InputError(fmt::format("tile: {} pixels; the mapping for GPUs needs 16", wanted));
  if (wanted != 0) return wanted;
  if (group) return 16;
  // A strand is processed once per tile that it touches, so large tiles need less work. Small tiles are
  // distributed more evenly over many cores.
  const long large = long((width + 127) / 128) * ((height + 127) / 128);
  return large >= 8L * device.compute_units ? 128 : 64;
}

std::string options_of(const PictureKinds& kinds) {
  const int shadow = kinds.shadow == Shadow::none     ? SHADOW_NONE
                     : kinds.shadow == Shadow::linear ? SHADOW_LINEAR
                                                      : SHADOW_EXPONENTIAL;
  return fmt::format("-D STRAND_LIGHTS={} -D STRAND_STYLES={} -D STRAND_SHADOW={}{}{}", int(kinds.lights),
                     int(kinds.styles), shadow, kinds.layers ? " -D STRAND_LAYERS=1" : "",
                     kinds.shapes ? " -D STRAND_SHAPES=1" : "");
}

/// What prepare_strands() and grow() will find for this scene, without growing the fur.
PictureKinds expected_kinds(const Scene& scene) {
  const std::vector<StrandLayerScene>& layers = scene.strands.layers;
  const bool film = std::ranges::any_of(layers, [](const StrandLayerScene& l) { return !l.film.empty(); });
  const bool shapes = scene.strands.groom == "file";
  const bool styles = std::ranges::any_of(
      layers, [&](const StrandLayerScene& l) { return shapes ? l.response != 1 : l.is_styled(); });
  const Look look = look_of(scene);
  return {film || has_lights(look), styles, has_layer_looks(look), shadow_named(scene.strands.shadow),
          shapes};
}

}  // namespace

DrawerLayout layout_of(const cl::DeviceInfo& device, int width, int height, const DrawerOptions& options) {
  const bool group = options.mapping == Drawing::standard ? !device.cpu : options.mapping == Drawing::group;
  return {group, tile_of(device, width, height, group, options.tile), cl::lanes_of(device, options.lanes),
          group ? 1 : tile_lanes_of(options.tile_lanes)};
}

DrawerLayout map_layout(const DrawerLayout& picture) {
  return {picture.group, picture.group ? group_map_tile : item_map_tile, picture.lanes,
          picture.group ? 1 : 16};
}

PictureTexts picture_texts(const PictureKinds& kinds, const DrawerLayout& layout, bool map, bool skin) {
  const std::string options = options_of(kinds);
  const std::string kind = map ? "-D STRAND_MAP=1" : fmt::format("-D STRAND_SKIN={}", int(skin));
  return {
      {"strands/draw/keys.cl", fmt::format("{} -D LANES={}", options, layout.lanes)},
      {"strands/draw/bins.cl",
       fmt::format("-D LANES=1 -D TILE_BLOCKS={}", layout.tile / block_side(layout.tile))},
      {layout.group ? "strands/draw/group.cl" : "strands/draw/tile.cl",
       fmt::format("{} {} -D LANES={} -D STRAND_TILE={}", options, kind, layout.tile_lanes, layout.tile)}};
}

cl::ProgramText skin_text(const PictureKinds& kinds, int lanes) {
  return {"strands/draw/skin.cl", fmt::format("{} -D LANES={}", options_of(kinds), lanes)};
}

cl::ProgramText chain_text(const ChainDynamics& dynamics, int lanes, bool follows, bool own_damping) {
  return {"strands/chain/chain.cl",
          fmt::format("-D LANES={} -D TURNING={} -D CHAIN_BODY={} -D CHAIN_SKIN={}{}", lanes,
                      int(!follows && springs::turns(dynamics.motion)), int(dynamics.body != nullptr),
                      int(follows), own_damping ? " -D CHAIN_DAMPING=1" : "")};
}

cl::ProgramText chain_keys_text(int lanes) {
  return {"strands/draw/chain_keys.cl", fmt::format("-D LANES={}", lanes)};
}

cl::ProgramText chain_contact_text(const ContactScene& contact, int lanes) {
  return {"strands/chain/contact.cl", fmt::format("-D LANES={}{}", lanes, contact_options(contact))};
}

std::vector<cl::ProgramText> expected_programs(const cl::Device& device, const Scene& scene,
                                               const DrawerOptions& options) {
  const DrawerLayout layout = layout_of(device.info(), scene.image.width, scene.image.height, options);
  const PictureKinds kinds = expected_kinds(scene);
  ChainDynamics dynamics = chain_dynamics(scene);
  if (scene.strands.chain.collision == "body") dynamics.body = std::make_shared<DistanceField>();
  const bool own_damping = std::ranges::any_of(
      scene.strands.layers, [](const StrandLayerScene& l) { return l.drag != 1 || l.damping != 1; });
  std::vector<cl::ProgramText> texts{chain_text(dynamics, device.info().lanes, false, own_damping),
                                     chain_keys_text(device.info().lanes)};
  for (const cl::ProgramText& text : cl::PairSort::program_texts(device, options.runs)) texts.push_back(text);
  const auto add = [&](const PictureTexts& picture) {
    texts.insert(texts.end(), {picture.keys, picture.draw, picture.lists});
  };
  const bool skin = scene.strands.skin && scene.model != no_model;
  add(picture_texts(kinds, layout, false, skin));
  if (kinds.shadow != Shadow::none) add(picture_texts(kinds, map_layout(layout), true, false));
  if (skin) texts.push_back(skin_text(kinds, layout.lanes));
  if (has_contact(scene.contact)) texts.push_back(chain_contact_text(scene.contact, device.info().lanes));
  if (scene.mesh.frames > 1) texts.push_back(chain_text(dynamics, device.info().lanes, true, own_damping));
  return texts;
}

}  // namespace pelage::strands
