#include "harness/strands/raycast/raycast.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>

#include "harness/error.hpp"
#include "harness/parallel.hpp"

namespace pelage::strands {
namespace {

constexpr unsigned strand_geometry = 0, skin_geometry = 1;

/// The place where a ray enters a strand.
struct Entered {
  float distance;
  std::uint32_t strand;
  float t;  ///< parameter of the strand's curve
};

/// What Embree's callback receives together with a ray.
struct Context {
  RTCIntersectContext base;  // must be the first member: Embree passes a pointer to it
  int cones;
  std::vector<Entered>* entered;
};

/// Embree calls this function for each hit of a strand. The function notes the hit and rejects it, so that
/// Embree finds the hits behind it, too.
void note_hit(const RTCFilterFunctionNArguments* arguments) {
  const auto* context = reinterpret_cast<const Context*>(arguments->context);
  const auto* ray = reinterpret_cast<const RTCRay*>(arguments->ray);
  const auto* hit = reinterpret_cast<const RTCHit*>(arguments->hit);
  arguments->valid[0] = 0;
  const float facing = hit->Ng_x * ray->dir_x + hit->Ng_y * ray->dir_y + hit->Ng_z * ray->dir_z;
  if (facing >= 0) return;  // the ray leaves the cone
  const auto cones = unsigned(context->cones);
  context->entered->push_back({ray->tfar, hit->primID / cones,
                               (float(hit->primID % cones) + std::clamp(hit->u, 0.0f, 1.0f)) / float(cones)});
}

glm::vec3 bezier(const DrawnStrand& strand, float t) {
  const float s = 1 - t;
  return s * s * strand.point[0] + 2 * s * t * strand.point[1] + t * t * strand.point[2];
}

/// Owns the objects of Embree.
class Rays {
 public:
  Rays(const RaycastScene& scene, const std::vector<DrawnStrand>& strands, int cones)
      : cones_(cones), device_(rtcNewDevice(nullptr)), scene_(device_ ? rtcNewScene(device_) : nullptr) {
    if (!scene_) throw DeviceError("Embree cannot start on this processor");
    add_strands(strands, scene);
    if (scene.skin) add_skin(*scene.skin);
    rtcCommitScene(scene_);
    if (rtcGetDeviceError(device_) != RTC_ERROR_NONE)
      throw DeviceError("Embree could not build its scene: the memory may be too small");
  }
  ~Rays() {
    if (scene_) rtcReleaseScene(scene_);
    if (device_) rtcReleaseDevice(device_);
  }
  Rays(const Rays&) = delete;
  Rays& operator=(const Rays&) = delete;

  /// Casts a ray with the unit vector `along`. Replaces `entered` by the places where the ray enters strands
  /// in front of the skin, from front to back. Returns the hit of the skin.
  RTCRayHit cast(glm::vec3 from, glm::vec3 along, float nearest, std::vector<Entered>& entered) const {
    entered.clear();
    Context context{{}, cones_, &entered};
    rtcInitIntersectContext(&context.base);
    RTCRayHit ray{};
    ray.ray = {from.x, from.y, from.z, nearest, along.x, along.y, along.z, 0, INFINITY, 0xffffffff, 0, 0};
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context.base, &ray);
    std::erase_if(entered, [&](const Entered& e) { return e.distance > ray.ray.tfar; });
    std::sort(entered.begin(), entered.end(), [](const Entered& a, const Entered& b) {
      return a.distance != b.distance ? a.distance < b.distance : a.strand < b.strand;
    });
    return ray;
  }

 private:
  void add_strands(const std::vector<DrawnStrand>& strands, const RaycastScene& of) {
    const auto cones = std::size_t(cones_);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
    auto* vertex =
        static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
                                                    4 * sizeof(float), strands.size() * (cones + 1)));
    auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, sizeof(unsigned), strands.size() * cones));
    auto* flags = static_cast<unsigned char*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_FLAGS, 0, RTC_FORMAT_UCHAR, 1, strands.size() * cones));
    if (!vertex || !index || !flags) throw DeviceError("Embree has too little memory for the strands");
    for (std::size_t s = 0; s < strands.size(); ++s) {
      for (std::size_t k = 0; k <= cones; ++k) {
        const float t = float(k) / float(cones);
        const glm::vec3 p = bezier(strands[s], t);
        float* v = vertex + 4 * (s * (cones + 1) + k);
        v[0] = p.x, v[1] = p.y, v[2] = p.z,
        v[3] = of.radius ? of.radius(std::uint32_t(s), t) : 0.5f * strands[s].width;
        if (k == cones) continue;
        index[s * cones + k] = unsigned(s * (cones + 1) + k);
        flags[s * cones + k] = static_cast<unsigned char>(
            (k > 0 ? RTC_CURVE_FLAG_NEIGHBOR_LEFT : 0) | (k + 1 < cones ? RTC_CURVE_FLAG_NEIGHBOR_RIGHT : 0));
      }
    }
    rtcSetGeometryIntersectFilterFunction(geometry, note_hit);
    attach(geometry, strand_geometry);
  }

  void add_skin(const Mesh& mesh) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.position.size()));
    auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), mesh.triangle.size()));
    if (!vertex || !index) throw DeviceError("Embree has too little memory for the skin");
    for (std::size_t v = 0; v < mesh.position.size(); ++v)
      for (int c = 0; c < 3; ++c) vertex[3 * v + std::size_t(c)] = mesh.position[v][c];
    for (std::size_t f = 0; f < mesh.triangle.size(); ++f)
      for (int c = 0; c < 3; ++c) index[3 * f + std::size_t(c)] = mesh.triangle[f][c];
    attach(geometry, skin_geometry);
  }

  void attach(RTCGeometry geometry, unsigned id) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene_, geometry, id);
    rtcReleaseGeometry(geometry);
  }

  int cones_;
  RTCDevice device_;
  RTCScene scene_;
};

/// A place on a strand. The curves of a strand of a file have places on one strand.
struct Place {
  std::uint32_t strand;
  float s;     ///< from 0 (root) to 1 (tip)
  float cone;  ///< part of the strand that one cone covers
};

Place place_of(const Entered& e, const std::vector<DrawnStrand>& strands, int cones) {
  const std::optional<StrandPart>& part = strands[e.strand].part;
  if (!part) return {e.strand, e.t, 1 / float(cones)};
  const float share = part->to - part->from;
  return {part->strand, part->from + share * e.t, share / float(cones)};
}

/// Removes entries into a strand that the ray has entered just before: neighbouring cones share a sphere, so
/// the ray may enter both.
void merge_neighbours(std::vector<Entered>& entered, const std::vector<DrawnStrand>& strands, int cones) {
  std::vector<Entered> kept;
  for (const Entered& e : entered) {
    const Place at = place_of(e, strands, cones);
    const bool again = std::any_of(kept.rbegin(), kept.rend(), [&](const Entered& k) {
      const Place before = place_of(k, strands, cones);
      return before.strand == at.strand &&
             std::abs(before.s - at.s) < 1.5f * std::max(before.cone, at.cone) &&
             e.distance - k.distance < 2 * std::max(strands[e.strand].width, strands[k.strand].width);
    });
    if (!again) kept.push_back(e);
  }
  entered = std::move(kept);
}

}  // namespace

RaycastResult raycast(const RaycastScene& scene, const std::vector<DrawnStrand>& strands,
                      const RaycastOptions& options) {
  if (options.cones < 1 || options.samples < 1)
    throw InputError("ray-casting of strands: the numbers of cones and samples must be at least 1");
  const Rays rays(scene, strands, options.cones);
  const Camera& camera = scene.camera;
  RaycastResult result{{camera.width, camera.height, {}}, 0};
  result.picture.pixel.resize(std::size_t(camera.width) * std::size_t(camera.height));
  std::atomic<std::uint64_t> hits = 0;
  const int side = options.samples;
  for_each_index(std::size_t(camera.height), [&](std::size_t y) {
    std::vector<Entered> entered;
    std::uint64_t row_hits = 0;
    for (int x = 0; x < camera.width; ++x) {
      glm::dvec3 sum(0);
      double through_sum = 0;
      for (int sample = 0; sample < side * side; ++sample) {
        const int column = sample % side, row = sample / side;
        const float px = float(x) + (float(column) + 0.5f) / float(side) - 0.5f * float(camera.width);
        const float py = float(y) + (float(row) + 0.5f) / float(side) - 0.5f * float(camera.height);
        const glm::vec3 ray = camera.ray + px * camera.ray_dx + py * camera.ray_dy;
        const float length = glm::length(ray);
        const float depth = glm::dot(glm::vec3(camera.row_w), ray) / length;  // view depth per distance
        const RTCRayHit end = rays.cast(camera.eye, ray / length, camera.near / depth, entered);
        merge_neighbours(entered, strands, options.cones);
        row_hits += entered.size();
        glm::dvec3 colour(0);
        double through = 1;
        for (const Entered& e : entered) {
          const Paint paint = scene.strand_paint(e.strand, e.t);
          colour += through * double(paint.alpha) * glm::dvec3(paint.colour);
          through *= 1 - double(paint.alpha);
        }
        const bool skin = end.hit.geomID == skin_geometry;
        const glm::vec3 behind =
            skin ? scene.skin_paint(end.hit.primID, {end.hit.u, end.hit.v}).colour : scene.background;
        sum += colour + through * glm::dvec3(behind);
        through_sum += skin ? 0 : through;
      }
      const double all = double(side) * side;
      result.picture.pixel[y * std::size_t(camera.width) + std::size_t(x)] =
          glm::vec4(glm::vec3(sum / all), float(1 - through_sum / all));
    }
    hits += row_hits;
  });
  result.hits = hits;
  return result;
}

}  // namespace pelage::strands
