// MuJoCo in WebAssembly: rays by mju_rayGeom, overlaps and depths by the contacts of mj_collision, for two geoms of a model.
import { Cannot } from "../../program/nearmiss.mjs";
import { answerBy, declared, length, load, minus, plus, scaled, turned } from "../engine.mjs";

const { version, library } = await load("mujoco-js");
const M = await library.default();
M.FS.writeFile("/pair.xml", "<mujoco><worldbody><geom size='1'/><body><freejoint/><geom size='1'/></body></worldbody></mujoco>");
const model = M.MjModel.loadFromXML("/pair.xml"), data = new M.MjData(model);

// Shapes: geoms, each with its place and its axes, row by row.
const still = [1, 0, 0, 0, 1, 0, 0, 0, 1];
const geom = (type, size, at, turn = still) => ({ type: M.mjtGeom[type].value, size, at, turn });
/** Axes of which the third one is along a vector. */
const axesAlong = (along) => {
  const z = scaled(along, 1 / length(along)), least = z.map(Math.abs).indexOf(Math.min(...z.map(Math.abs)));
  const cross = ([a, b, c], [d, e, f]) => [b * f - c * e, c * d - a * f, a * e - b * d];
  const across = cross(z, [0, 1, 2].map((i) => (i === least ? 1 : 0))), y = scaled(across, 1 / length(across)), x = cross(y, z);
  return [0, 1, 2].flatMap((i) => [x[i], y[i], z[i]]);
};
const sphere = ({ center, radius }) => geom("mjGEOM_SPHERE", [radius, 0, 0], center);
const box = ({ center, half, orientation }) => {
  const [x, y, z, w] = turned(orientation);
  return geom("mjGEOM_BOX", half, center, [
    1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
    2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
    2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y),
  ]);
};
const capsule = ({ p0, p1, radius }) => {
  const along = minus(p1, p0), half = length(along) / 2;
  return geom("mjGEOM_CAPSULE", [radius, half, 0], scaled(plus(p0, p1), 0.5), axesAlong(half > 0 ? along : [0, 0, 1]));
};
const plane = ({ normal, offset }) =>
  geom("mjGEOM_PLANE", [0, 0, 0], scaled(normal, -offset / length(normal) / length(normal)), axesAlong(normal));

// Calls. Geoms without a bounding radius meet in every place.
function set(geoms) {
  geoms.forEach(({ type, size, at, turn }, i) => {
    model.geom_type[i] = type, model.geom_rbound[i] = 0;
    model.geom_size.set(size, 3 * i), data.geom_xpos.set(at, 3 * i), data.geom_xmat.set(turn, 9 * i);
  });
}
/** The deepest contact of two geoms, of which the first has the lower type: its depth and normal; undefined where there is none. */
function contact(...geoms) {
  set(geoms);
  M.mj_collision(model, data);
  const list = data.contact, found = [];
  for (let i = 0; i < list.size(); ++i) {
    const c = list.get(i);
    found.push({ depth: -c.dist, normal: [...c.frame].slice(0, 3) });
    c.delete();
  }
  list.delete();
  return found.sort((c, d) => d.depth - c.depth).find((c) => c.depth >= 0);
}
const meet = (a, b) => contact(a, b) !== undefined;
const depth = (a, b) => contact(a, b) ?? false;
const ends = new M.DoubleBuffer(6);
/** The signed distance of two geoms, which are no further apart than their places. */
function distance(a, b) {
  set([a, b]);
  const most = 2 * length(minus(b.at, a.at)) + a.size[0];
  const found = M.mj_geomDistance(model, data, 0, 1, most, ends), [x, y, z, ...point2] = ends.GetView();
  return found < most ? { distance: found, point1: [x, y, z], point2 } : new Cannot("mj_geomDistance finds no distance");
}
function ray({ point, velocity }, { type, size, at, turn }) {
  if (!(length(velocity) > 0)) return new Cannot("a ray has a direction");
  const time = M.mju_rayGeom(at, turn, size, point, velocity, type);
  return time >= 0 && { time };
}

// MuJoCo's compiler of models refuses sizes of zero: 'size must be positive in geom'.
const requires = ["no zero sizes"], gives = ["depth", "normal"];
const surface = "mj_ray: 'Intersect ray (pnt+x*vec, x>=0) with visible geoms', 'Return distance (x) to nearest surface, or -1 if no intersection'";
const rays = { gives: ["time"], requires, declares: [declared("contact where it leaves", surface)] };
const overlaps = { gives: [], requires }, depths = { gives, requires }, distances = { gives: ["distance", "point1", "point2"], requires };
answerBy({
  name: "mujoco-js", version: `MuJoCo ${M.mj_versionString()}, mujoco-js ${version}`, scalar: "double",
  queries: {
    moving_point_plane: { answer: (q) => ray(q, plane(q.plane)), gives: ["time"], requires },
    moving_point_sphere: { answer: (q) => ray(q, sphere(q.sphere)), ...rays },
    moving_point_capsule: { answer: (q) => ray(q, capsule(q.capsule)), ...rays },
    moving_point_box: { answer: (q) => ray(q, box(q.box)), ...rays },
    sphere_sphere_overlap: { answer: (q) => meet(sphere(q.sphere1), sphere(q.sphere2)), ...overlaps },
    sphere_capsule_overlap: { answer: (q) => meet(sphere(q.sphere), capsule(q.capsule)), ...overlaps },
    sphere_box_overlap: { answer: (q) => meet(sphere(q.sphere), box(q.box)), ...overlaps },
    capsule_capsule_overlap: { answer: (q) => meet(capsule(q.capsule1), capsule(q.capsule2)), ...overlaps },
    capsule_box_overlap: { answer: (q) => meet(capsule(q.capsule), box(q.box)), ...overlaps },
    box_box_overlap: { answer: (q) => meet(box(q.box1), box(q.box2)), ...overlaps },
    sphere_sphere_penetration: { answer: (q) => depth(sphere(q.sphere1), sphere(q.sphere2)), ...depths },
    sphere_box_penetration: { answer: (q) => depth(sphere(q.sphere), box(q.box)), ...depths },
    sphere_plane_penetration: { answer: (q) => depth(plane(q.plane), sphere(q.sphere)), ...depths },
    box_plane_penetration: { answer: (q) => depth(plane(q.plane), box(q.box)), ...depths },
    box_box_penetration: { answer: (q) => depth(box(q.box1), box(q.box2)), ...depths },
    sphere_sphere_signed_distance: { answer: (q) => distance(sphere(q.sphere1), sphere(q.sphere2)), ...distances },
    sphere_capsule_signed_distance: { answer: (q) => distance(sphere(q.sphere), capsule(q.capsule)), ...distances },
    capsule_capsule_signed_distance: { answer: (q) => distance(capsule(q.capsule1), capsule(q.capsule2)), ...distances },
  },
});
