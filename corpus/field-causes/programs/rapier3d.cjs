// Rapier: rays, overlaps, contacts and casts of its shapes.
const { load, speak, dot, minus, plus, length, scaled, unit, timeToPass } = require("./speak.cjs");

load("@dimforge/rapier3d-compat").then(async ({ version, library }) => {
  const R = library.default && library.default.init ? library.default : library;
  await R.init();
  const vec = ([x, y, z]) => ({ x, y, z });
  const list = ({ x, y, z }) => [x, y, z];
  const still = { x: 0, y: 0, z: 0, w: 1 };
  const ball = (at, r) => ({ shape: new R.Ball(r), at, turn: still });
  const box = (v) => {
    const [x, y, z, w] = scaled(v.slice(6, 10), 1 / Math.hypot(...v.slice(6, 10)));
    return { shape: new R.Cuboid(v[3], v[4], v[5]), at: v.slice(0, 3), turn: { x, y, z, w } };
  };
  /** Rapier's capsules are along y. */
  const capsule = (p0, p1, r) => {
    const along = minus(p1, p0), l = length(along), middle = scaled(plus(p0, p1), 0.5);
    const [x, y, z] = l > 0 ? scaled(along, 1 / l) : [0, 1, 0];
    const q = y > -1 ? [z, 0, -x, 1 + y] : [1, 0, 0, 0], n = Math.hypot(...q);
    return { shape: new R.Capsule(l / 2, r), at: middle, turn: { x: q[0] / n, y: q[1] / n, z: q[2] / n, w: q[3] / n } };
  };
  const triangle = (v) => ({ shape: new R.Triangle(vec(v.slice(0, 3)), vec(v.slice(3, 6)), vec(v.slice(6, 9))), at: [0, 0, 0], turn: still });
  const plane = (n, offset) => ({ shape: new R.HalfSpace(vec(unit(n))), at: scaled(unit(n), -offset / length(n)), turn: still });

  function ray(v, b, solid) {
    if (!(length(v.slice(3, 6)) > 0)) return { cannot: "a ray has a direction" };
    const hit = b.shape.castRayAndGetNormal(new R.Ray(vec(v), vec(v.slice(3, 6))), vec(b.at), b.turn, 3e38, solid);
    return hit ? { yes: true, values: [hit.timeOfImpact, null, null, null, ...list(hit.normal)] } : { yes: false };
  }
  const meet = (a, b) => ({ yes: a.shape.intersectsShape(vec(a.at), a.turn, b.shape, vec(b.at), b.turn) });
  /** `sign`: -1 where the query's normal is that of the second body. */
  function depth(a, b, sign = 1) {
    const c = a.shape.contactShape(vec(a.at), a.turn, b.shape, vec(b.at), b.turn, 0);
    if (!c || c.distance > 0) return null;
    return [-c.distance, ...list(c.normal1).map((x) => sign * x)];
  }
  const penetration = (said) => said ? { yes: true, values: [...said, null, null, null] } : { yes: false, values: Array(7).fill("none") };
  function sweep(v, b) {
    const velocity = v.slice(4, 7), still3 = vec([0, 0, 0]);
    const hit = b.shape.castShape(vec(b.at), b.turn, still3, new R.Ball(v[3]), vec(v), still, vec(velocity), 0, 3e38, true);
    return hit ? { yes: true, values: [hit.time_of_impact, ...Array(6).fill(null)] } : { yes: false };
  }
  const functions = {
    moving_point_sphere: (v) => ray(v, ball(v.slice(6, 9), v[9]), v[10] === 1),
    moving_point_box: (v) => ray(v, box(v.slice(6)), true),
    moving_point_capsule: (v) => ray(v, capsule(v.slice(6, 9), v.slice(9, 12), v[12]), true),
    moving_point_triangle: (v) => ray(v, triangle(v.slice(6)), true),
    moving_point_plane: (v) => ray(v, plane(v.slice(6, 9), v[9]), true),
    sphere_sphere_overlap: (v) => meet(ball(v.slice(0, 3), v[3]), ball(v.slice(4, 7), v[7])),
    sphere_box_overlap: (v) => meet(ball(v.slice(0, 3), v[3]), box(v.slice(4))),
    sphere_triangle_overlap: (v) => meet(ball(v.slice(0, 3), v[3]), triangle(v.slice(4))),
    box_box_overlap: (v) => ({ ...meet(box(v), box(v.slice(10))), values: [null] }),
    sphere_sphere_penetration: (v) => penetration(depth(ball(v.slice(0, 3), v[3]), ball(v.slice(4, 7), v[7]))),
    sphere_box_penetration: (v) => penetration(depth(ball(v.slice(0, 3), v[3]), box(v.slice(4)))),
    sphere_plane_penetration: (v) => penetration(depth(ball(v.slice(0, 3), v[3]), plane(v.slice(4, 7), v[7]), -1)),
    box_box_penetration: (v) => {
      const said = depth(box(v), box(v.slice(10)));
      return said ? { yes: true, values: [said[0], null, ...said.slice(1), null, null, null] } : { yes: false, values: Array(8).fill("none") };
    },
    moving_sphere_sphere: (v) => sweep(v, ball(v.slice(7, 10), v[10])),
    moving_sphere_box: (v) => sweep(v, box(v.slice(7))),
    moving_sphere_capsule: (v) => sweep(v, capsule(v.slice(7, 10), v.slice(10, 13), v[13])),
  };
  const rays = ["time", "normal"], depths = ["depth", "normal"];
  speak({ name: "rapier3d", version: `rapier3d-compat ${version}`, scalar: "float" }, {
    moving_point_sphere: rays, moving_point_box: rays, moving_point_capsule: rays, moving_point_triangle: rays, moving_point_plane: rays,
    box_box_overlap: [], sphere_sphere_penetration: depths, sphere_box_penetration: depths, sphere_plane_penetration: depths, box_box_penetration: depths,
    moving_sphere_sphere: ["time"], moving_sphere_box: ["time"], moving_sphere_capsule: ["time"],
  }, functions);
});
