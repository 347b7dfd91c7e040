/// Embree as a plugin, in float: rays against a triangle, a rectangle, a sphere and a capsule, and whether a segment
/// meets a triangle. The setting robust has the scene's flag RTC_SCENE_FLAG_ROBUST.
#include <embree3/rtcore.h>

#include <cmath>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <string_view>
#include <vector>

#include "nearmiss_plugin.h"

namespace {

RTCDevice device() {
  static const RTCDevice one = rtcNewDevice("threads=1");
  return one;
}

/// A scene with one primitive.
class TracedShape {
 public:
  /// `floats_each`: 3 for positions, 4 for positions with a radius.
  TracedShape(RTCGeometryType type, int floats_each, const std::vector<float>& vertices,
              std::initializer_list<unsigned> indices)
      : scene_(rtcNewScene(device())) {
    const RTCGeometry geometry = rtcNewGeometry(device(), type);
    const RTCFormat format = floats_each == 3 ? RTC_FORMAT_FLOAT3 : RTC_FORMAT_FLOAT4;
    void* to = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, format, floats_each * sizeof(float),
                                       vertices.size() / floats_each);
    std::memcpy(to, vertices.data(), vertices.size() * sizeof(float));
    if (indices.size() > 0) {
      constexpr RTCFormat formats[] = {RTC_FORMAT_UINT, RTC_FORMAT_UINT2, RTC_FORMAT_UINT3, RTC_FORMAT_UINT4};
      void* list = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, formats[indices.size() - 1],
                                           indices.size() * sizeof(unsigned), 1);
      std::memcpy(list, indices.begin(), indices.size() * sizeof(unsigned));
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    if (std::string_view(SETTING) == "robust") rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(scene_);
  }
  TracedShape(const TracedShape&) = delete;
  TracedShape& operator=(const TracedShape&) = delete;
  ~TracedShape() { rtcReleaseScene(scene_); }

  operator RTCScene() const { return scene_; }

 private:
  RTCScene scene_;
};

std::vector<float> floats(const double* from, int count) { return {from, from + count}; }
TracedShape triangle(const double* in) { return {RTC_GEOMETRY_TYPE_TRIANGLE, 3, floats(in, 9), {0, 1, 2}}; }

RTCRay ray_of(const double* start, const double* way, float end) {
  RTCRay ray{};
  ray.org_x = static_cast<float>(start[0]), ray.org_y = static_cast<float>(start[1]),
  ray.org_z = static_cast<float>(start[2]);
  ray.dir_x = static_cast<float>(way[0]), ray.dir_y = static_cast<float>(way[1]),
  ray.dir_z = static_cast<float>(way[2]);
  ray.tfar = end, ray.mask = ~0u;
  return ray;
}
int cannot(nearmiss_answer* answer, const char* why) {
  std::strcpy(answer->why, why);
  return NEARMISS_CANNOT_ANSWER;
}

/// The closest hit of a ray with the velocity as its direction, so that its distance is a time.
int hit(const double* in, const TracedShape& scene, nearmiss_answer* answer) {
  if (in[3] == 0 && in[4] == 0 && in[5] == 0) return cannot(answer, "a ray has a direction");
  RTCRayHit found{};
  found.ray = ray_of(in, in + 3, std::numeric_limits<float>::infinity());
  found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &found);
  answer->yes = found.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  if (!answer->yes) return NEARMISS_ANSWERED;
  const double n[] = {found.hit.Ng_x, found.hit.Ng_y, found.hit.Ng_z}, length = std::hypot(n[0], n[1], n[2]);
  answer->given = 0b1110001;  // the time and the normal
  answer->values[0] = found.ray.tfar;
  for (int i = 0; i < 3; ++i) answer->values[4 + i] = n[i] / length;
  return NEARMISS_ANSWERED;
}

int moving_point_triangle(const double* in, std::size_t, nearmiss_answer* answer) {
  return hit(in, triangle(in + 6), answer);
}
int moving_point_rectangle(const double* in, std::size_t, nearmiss_answer* answer) {
  return hit(in, {RTC_GEOMETRY_TYPE_QUAD, 3, floats(in + 6, 12), {0, 1, 2, 3}}, answer);
}
int moving_point_sphere(const double* in, std::size_t, nearmiss_answer* answer) {
  return hit(in, {RTC_GEOMETRY_TYPE_SPHERE_POINT, 4, floats(in + 6, 4), {}}, answer);
}
int moving_point_capsule(const double* in, std::size_t, nearmiss_answer* answer) {
  std::vector<float> ends = floats(in + 6, 3);
  for (const double x : {in[12], in[9], in[10], in[11], in[12]}) ends.push_back(static_cast<float>(x));
  return hit(in, {RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE, 4, ends, {0}}, answer);
}

int segment_triangle_overlap(const double* in, std::size_t, nearmiss_answer* answer) {
  double way[3];
  bool moves = false;
  for (int i = 0; i < 3; ++i) {
    way[i] = in[3 + i] - in[i];
    moves |= way[i] != 0;
    // Both ends are floats: a difference that is a float again, and gives the end back in long double, is exact.
    const long double end = static_cast<long double>(in[i]) + static_cast<long double>(way[i]);
    if (static_cast<float>(way[i]) != way[i] || end != in[3 + i])
      return cannot(answer, "a ray has a start and a way, and floats do not hold the way between the ends");
  }
  if (!moves) return cannot(answer, "a ray has a direction");
  RTCRay ray = ray_of(in, way, 1);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(triangle(in + 6), &context, &ray);
  answer->yes = ray.tfar < 0, answer->given = 0;
  return NEARMISS_ANSWERED;
}

const nearmiss_offer offers[] = {
    {"moving_point_triangle", 15, 7, nullptr, nullptr, moving_point_triangle, 0},
    {"moving_point_rectangle", 18, 7, nullptr, nullptr, moving_point_rectangle, NEARMISS_TRUE_RECTANGLE},
    {"moving_point_sphere", 11, 7, nullptr, nullptr, moving_point_sphere, 0},
    {"moving_point_capsule", 13, 7, nullptr, nullptr, moving_point_capsule, 0},
    {"segment_triangle_overlap", 15, 0, "rtcOccluded1", nullptr, segment_triangle_overlap, 0},
};
const nearmiss_plugin embree = {NEARMISS_PLUGIN_VERSION,        SUBJECT, "Embree " RTC_VERSION_STRING, NEARMISS_FLOAT,
                                sizeof offers / sizeof *offers, offers};

constexpr const char* front =
    "RTC_GEOMETRY_TYPE_TRIANGLE: 'A triangle whose vertices are laid out counter-clockwise has its geometry normal "
    "pointing "
    "upwards outside the front face'";
constexpr const char* culling =
    "RTC_DEVICE_PROPERTY_BACKFACE_CULLING_ENABLED: 'Queries whether back face culling is enabled. This is only the "
    "case if "
    "Embree is compiled with EMBREE_BACKFACE_CULLING enabled.'";
constexpr const char* sphere_surface =
    "RTC_GEOMETRY_TYPE_SPHERE_POINT: 'a real geometric surface is rendered'; rtcIntersect1 'finds the closest hit of a "
    "single ray'";
constexpr const char* curve_surface =
    "RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE: 'a real geometric surface is rendered for the curve'; rtcIntersect1 'finds "
    "the closest hit "
    "of a single ray'";
const nearmiss_declaration declarations[] = {
    {"moving_point_triangle", "two-sided", culling},
    {"moving_point_triangle", "normal of the front", front},
    {"moving_point_rectangle", "two-sided", culling},
    {"moving_point_rectangle", "normal of the front", front},
    {"moving_point_sphere", "contact where it leaves", sphere_surface},
    {"moving_point_capsule", "contact where it leaves", curve_surface},
    {nullptr, nullptr, nullptr},
};

}  // namespace

extern "C" const nearmiss_plugin* nearmiss_plugin_entry(void) { return &embree; }
extern "C" const nearmiss_declaration* nearmiss_plugin_declarations(void) { return declarations; }
