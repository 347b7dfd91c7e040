/// MuJoCo as a plugin, in double: rays by mju_rayGeom, overlaps and depths by the contacts of its table of collision
/// functions, for two geoms of a model.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "nearmiss_plugin.h"

namespace {

struct Geom {
  mjtGeom type;
  mjtNum size[3], at[3], turn[9];
};
/// The geom with its third axis along a vector.
Geom turned_to(Geom g, const mjtNum* along) {
  mjtNum z[3] = {along[0], along[1], along[2]}, x[3] = {0, 0, 0}, y[3];
  mju_normalize3(z);
  x[std::min_element(z, z + 3, [](mjtNum c, mjtNum d) { return std::abs(c) < std::abs(d); }) - z] = 1;
  mju_cross(y, z, x);
  mju_normalize3(y);
  mju_cross(x, y, z);
  for (int i = 0; i < 3; ++i) g.turn[3 * i] = x[i], g.turn[3 * i + 1] = y[i], g.turn[3 * i + 2] = z[i];
  return g;
}
Geom sphere(const double* in) { return {mjGEOM_SPHERE, {in[3]}, {in[0], in[1], in[2]}, {1, 0, 0, 0, 1, 0, 0, 0, 1}}; }
Geom box(const double* in) {
  Geom g{mjGEOM_BOX, {in[3], in[4], in[5]}, {in[0], in[1], in[2]}, {}};
  mjtNum quaternion[4] = {in[9], in[6], in[7], in[8]};
  mju_normalize4(quaternion);
  mju_quat2Mat(g.turn, quaternion);
  return g;
}
Geom capsule(const double* in) {
  mjtNum axis[3], middle[3];
  mju_sub3(axis, in + 3, in);
  mju_add3(middle, in, in + 3);
  const mjtNum half = mju_norm3(axis) / 2;
  const mjtNum z[3] = {0, 0, 1};
  return turned_to({mjGEOM_CAPSULE, {in[6], half}, {middle[0] / 2, middle[1] / 2, middle[2] / 2}, {}},
                   half > 0 ? axis : z);
}
Geom plane(const double* in) {
  const mjtNum square = in[0] * in[0] + in[1] * in[1] + in[2] * in[2], foot = -in[3] / square;
  return turned_to({mjGEOM_PLANE, {}, {foot * in[0], foot * in[1], foot * in[2]}, {}}, in);
}

/// A model with two geoms, which are changed for each case.
struct Pair {
  mjModel* model;
  mjData* data;
};
const Pair& pair() {
  static const Pair one = [] {
    constexpr char xml[] =
        "<mujoco><worldbody><geom size='1'/><body><freejoint/><geom size='1'/></body></worldbody></mujoco>";
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), "pair.xml", sizeof xml - 1);
    std::memcpy(files->filedata[0], xml, sizeof xml - 1);
    char why[1000] = "";
    mjModel* model = mj_loadXML("pair.xml", files.get(), why, sizeof why);
    mj_deleteVFS(files.get());
    if (model == nullptr) mju_error(why);
    return Pair{model, mj_makeData(model)};
  }();
  return one;
}
/// The deepest contact of two geoms, of which the first has the lower type; null where there is none.
const mjContact* contact(const Geom& a, const Geom& b) {
  static mjContact found[mjMAXCONPAIR];
  const Pair& p = pair();
  for (const int i : {0, 1}) {
    const Geom& g = i == 0 ? a : b;
    p.model->geom_type[i] = g.type;
    std::copy_n(g.size, 3, p.model->geom_size + 3 * i);
    std::copy_n(g.at, 3, p.data->geom_xpos + 3 * i);
    std::copy_n(g.turn, 9, p.data->geom_xmat + 9 * i);
  }
  const int count = mjCOLLISIONFUNC[a.type][b.type](p.model, p.data, found, 0, 1, 0);
  const auto nearest =
      std::min_element(found, found + count, [](const auto& c, const auto& d) { return c.dist < d.dist; });
  return count > 0 && nearest->dist <= 0 ? nearest : nullptr;
}

int overlap(const Geom& a, const Geom& b, nearmiss_answer* answer) {
  answer->yes = contact(a, b) != nullptr, answer->given = 0;
  return NEARMISS_ANSWERED;
}
/// `normal`: the place of the normal among the values.
int depth(const Geom& a, const Geom& b, int normal, nearmiss_answer* answer) {
  const mjContact* c = contact(a, b);
  answer->yes = c != nullptr, answer->given = 0;
  if (c == nullptr) return NEARMISS_ANSWERED;
  answer->given = 1 | uint64_t{7} << normal;
  answer->values[0] = -c->dist;
  std::copy_n(c->frame, 3, answer->values + normal);
  return NEARMISS_ANSWERED;
}
int ray(const double* in, const Geom& g, nearmiss_answer* answer) {
  if (in[3] == 0 && in[4] == 0 && in[5] == 0) {
    std::strcpy(answer->why, "a ray has a direction");
    return NEARMISS_CANNOT_ANSWER;
  }
  const mjtNum x = mju_rayGeom(g.at, g.turn, g.size, in, in + 3, g.type);
  answer->yes = x >= 0, answer->given = 0;
  if (x >= 0) answer->given = 1, answer->values[0] = x;
  return NEARMISS_ANSWERED;
}

template <Geom target(const double*)>
int moving_point(const double* in, std::size_t, nearmiss_answer* answer) {
  return ray(in, target(in + 6), answer);
}
/// An overlap whose first shape has `count` numbers.
template <Geom first(const double*), int count, Geom second(const double*)>
int overlap_of(const double* in, std::size_t, nearmiss_answer* answer) {
  return overlap(first(in), second(in + count), answer);
}
template <Geom first(const double*), int count, Geom second(const double*)>
int depth_of(const double* in, std::size_t, nearmiss_answer* answer) {
  return depth(first(in), second(in + count), 1, answer);
}
/// MuJoCo's planes come first.
template <Geom first(const double*), int count>
int depth_in_plane(const double* in, std::size_t, nearmiss_answer* answer) {
  return depth(plane(in + count), first(in), 1, answer);
}
int box_box_penetration(const double* in, std::size_t, nearmiss_answer* answer) {
  return depth(box(in), box(in + 10), 2, answer);
}

// MuJoCo's compiler of models refuses sizes of zero: 'size must be positive in geom'.
const nearmiss_offer offers[] = {
    {"moving_point_plane", 10, 7, nullptr, nullptr, moving_point<plane>, NEARMISS_NO_ZERO_SIZES},
    {"moving_point_sphere", 11, 7, nullptr, nullptr, moving_point<sphere>, NEARMISS_NO_ZERO_SIZES},
    {"moving_point_capsule", 13, 7, nullptr, nullptr, moving_point<capsule>, NEARMISS_NO_ZERO_SIZES},
    {"moving_point_box", 16, 7, nullptr, nullptr, moving_point<box>, NEARMISS_NO_ZERO_SIZES},
    {"sphere_sphere_overlap", 8, 0, nullptr, nullptr, overlap_of<sphere, 4, sphere>, NEARMISS_NO_ZERO_SIZES},
    {"sphere_capsule_overlap", 11, 0, nullptr, nullptr, overlap_of<sphere, 4, capsule>, NEARMISS_NO_ZERO_SIZES},
    {"sphere_box_overlap", 14, 0, nullptr, nullptr, overlap_of<sphere, 4, box>, NEARMISS_NO_ZERO_SIZES},
    {"capsule_capsule_overlap", 14, 0, nullptr, nullptr, overlap_of<capsule, 7, capsule>, NEARMISS_NO_ZERO_SIZES},
    {"capsule_box_overlap", 17, 0, nullptr, nullptr, overlap_of<capsule, 7, box>, NEARMISS_NO_ZERO_SIZES},
    {"box_box_overlap", 21, 1, nullptr, nullptr, overlap_of<box, 10, box>, NEARMISS_NO_ZERO_SIZES},
    {"sphere_sphere_penetration", 8, 7, nullptr, nullptr, depth_of<sphere, 4, sphere>, NEARMISS_NO_ZERO_SIZES},
    {"sphere_box_penetration", 14, 7, nullptr, nullptr, depth_of<sphere, 4, box>, NEARMISS_NO_ZERO_SIZES},
    {"sphere_plane_penetration", 8, 7, nullptr, nullptr, depth_in_plane<sphere, 4>, NEARMISS_NO_ZERO_SIZES},
    {"box_plane_penetration", 14, 36, nullptr, nullptr, depth_in_plane<box, 10>, NEARMISS_NO_ZERO_SIZES},
    {"box_box_penetration", 21, 8, nullptr, nullptr, box_box_penetration, NEARMISS_NO_ZERO_SIZES},
};
const nearmiss_plugin mujoco = {NEARMISS_PLUGIN_VERSION,        SUBJECT, "MuJoCo 2.2.2", NEARMISS_DOUBLE,
                                sizeof offers / sizeof *offers, offers};
static_assert(mjVERSION_HEADER == 222);

constexpr const char* surface =
    "mj_ray: 'Intersect ray (pnt+x*vec, x>=0) with visible geoms', 'Return distance (x) to nearest surface, or -1 if "
    "no intersection'";
const nearmiss_declaration declarations[] = {
    {"moving_point_sphere", "contact where it leaves", surface},
    {"moving_point_capsule", "contact where it leaves", surface},
    {"moving_point_box", "contact where it leaves", surface},
    {nullptr, nullptr, nullptr},
};

}  // namespace

extern "C" const nearmiss_plugin* nearmiss_plugin_entry(void) { return &mujoco; }
extern "C" const nearmiss_declaration* nearmiss_plugin_declarations(void) { return declarations; }
