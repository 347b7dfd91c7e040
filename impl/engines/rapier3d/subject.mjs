// Rapier: rays, overlaps, contacts and casts of its shapes.
import { Cannot } from "../../program/nearmiss.mjs";
import { answerBy, declared, declares, length, load, minus, plus, scaled, turned, turnOf, unit } from "../engine.mjs";

const { version, library: R } = await load("@dimforge/rapier3d-compat");
await R.init();
const vec = ([x, y, z]) => ({ x, y, z });
const list = ({ x, y, z }) => [x, y, z];
const quat = ([x, y, z, w]) => ({ x, y, z, w });

// Shapes, each with its place.
const still = quat([0, 0, 0, 1]);
const sphere = ({ center, radius }) => ({ shape: new R.Ball(radius), at: center, turn: still });
const box = ({ center, half, orientation }) => ({ shape: new R.Cuboid(...half), at: center, turn: quat(turned(orientation)) });
const capsule = ({ p0, p1, radius }) => {  // Rapier's capsules are along y
  const along = minus(p1, p0), l = length(along);
  const turn = turnOf("y", l > 0 ? scaled(along, 1 / l) : [0, 1, 0]);
  return { shape: new R.Capsule(l / 2, radius), at: scaled(plus(p0, p1), 0.5), turn: quat(turn) };
};
const segment = ({ v0, v1 }) => ({ shape: new R.Segment(vec(v0), vec(v1)), at: [0, 0, 0], turn: still });
const triangle = ({ v0, v1, v2 }) => ({ shape: new R.Triangle(vec(v0), vec(v1), vec(v2)), at: [0, 0, 0], turn: still });
const plane = ({ normal, offset }) => ({ shape: new R.HalfSpace(vec(unit(normal))), at: scaled(unit(normal), -offset / length(normal)), turn: still });

// Calls.
const ever = 3e38;
function ray({ point, velocity }, b, isSolid = true) {
  if (!(length(velocity) > 0)) return new Cannot("a ray has a direction");
  const hit = b.shape.castRayAndGetNormal(new R.Ray(vec(point), vec(velocity)), vec(b.at), b.turn, ever, isSolid);
  if (!hit) return null;
  const isUndefined = declares && isSolid && hit.timeOfImpact === 0;
  return { time: hit.timeOfImpact, normal: isUndefined ? null : list(hit.normal) };
}
const meet = (a, b) => a.shape.intersectsShape(vec(a.at), a.turn, b.shape, vec(b.at), b.turn);
const contains = (a, point) => a.shape.containsPoint(vec(a.at), a.turn, vec(point));
/** `sign`: -1 where the query's normal is that of the second body. */
function depth(a, b, sign = 1) {
  const c = a.shape.contactShape(vec(a.at), a.turn, b.shape, vec(b.at), b.turn, 0);
  if (!c || c.distance > 0) return false;
  return { depth: -c.distance, normal: scaled(list(c.normal1), sign) };
}
/** The signed distance, as Rapier's contact of shapes at any distance. */
function distance(a, b) {
  const c = a.shape.contactShape(vec(a.at), a.turn, b.shape, vec(b.at), b.turn, ever);
  if (!c) return new Cannot("contactShape gives no contact");
  return { distance: c.distance, normal: list(c.normal1), point1: list(c.point1), point2: list(c.point2) };
}
/** The nearest point of a surface. Rapier gives nothing else of a distance of points. */
const projection = (point, b) => ({ point2: list(b.shape.projectPoint(vec(b.at), b.turn, vec(point), false).point) });
function cast({ sphere: { center, radius }, velocity }, b) {
  const hit = b.shape.castShape(vec(b.at), b.turn, vec([0, 0, 0]), new R.Ball(radius), vec(center), still, vec(velocity), 0, ever, true);
  return hit && { time: hit.time_of_impact };
}

const solid = "Solid ray cast: 'A solid ray cast (solid is set to true) will return an intersection with its toi field set to zero and its normal undefined'";
const inside = [declared("start in contact is a hit", solid)];
const stops = "Shape.castShape: 'stopAtPenetration - If set to `false`, the linear shape-cast won’t immediately stop if the shape is penetrating another shape at its starting point'";
const rays = ["time", "normal"], gives = ["depth", "normal"], times = ["time"], points = ["point2"];
answerBy({
  name: "rapier3d", version: `rapier3d-compat ${version}`, scalar: "float",
  queries: {
    moving_point_sphere: { answer: (q) => ray(q, sphere(q.sphere), q.solid === 1), gives: rays },
    moving_point_box: { answer: (q) => ray(q, box(q.box)), gives: rays, declares: inside },
    moving_point_capsule: { answer: (q) => ray(q, capsule(q.capsule)), gives: rays, declares: inside },
    moving_point_triangle: { answer: (q) => ray(q, triangle(q.triangle)), gives: rays },
    moving_point_plane: { answer: (q) => ray(q, plane(q.plane)), gives: rays, declares: inside },
    sphere_sphere_overlap: (q) => meet(sphere(q.sphere1), sphere(q.sphere2)),
    sphere_box_overlap: (q) => meet(sphere(q.sphere), box(q.box)),
    sphere_triangle_overlap: (q) => meet(sphere(q.sphere), triangle(q.triangle)),
    point_sphere_overlap: (q) => contains(sphere(q.sphere), q.point),
    point_capsule_overlap: (q) => contains(capsule(q.capsule), q.point),
    point_box_overlap: (q) => contains(box(q.box), q.point),
    sphere_segment_overlap: (q) => meet(sphere(q.sphere), segment(q.segment)),
    sphere_capsule_overlap: (q) => meet(sphere(q.sphere), capsule(q.capsule)),
    segment_capsule_overlap: (q) => meet(segment(q.segment), capsule(q.capsule)),
    segment_triangle_overlap: (q) => meet(segment(q.segment), triangle(q.triangle)),
    segment_box_overlap: (q) => meet(segment(q.segment), box(q.box)),
    capsule_capsule_overlap: (q) => meet(capsule(q.capsule1), capsule(q.capsule2)),
    capsule_triangle_overlap: (q) => meet(capsule(q.capsule), triangle(q.triangle)),
    capsule_box_overlap: (q) => meet(capsule(q.capsule), box(q.box)),
    triangle_triangle_overlap: (q) => meet(triangle(q.triangle1), triangle(q.triangle2)),
    triangle_box_overlap: (q) => meet(triangle(q.triangle), box(q.box)),
    box_box_overlap: { answer: (q) => meet(box(q.box1), box(q.box2)), gives: [] },
    sphere_sphere_penetration: { answer: (q) => depth(sphere(q.sphere1), sphere(q.sphere2)), gives },
    sphere_box_penetration: { answer: (q) => depth(sphere(q.sphere), box(q.box)), gives },
    sphere_plane_penetration: { answer: (q) => depth(sphere(q.sphere), plane(q.plane), -1), gives },
    box_box_penetration: { answer: (q) => depth(box(q.box1), box(q.box2)), gives },
    moving_sphere_sphere: { answer: (q) => cast(q, sphere(q.fixed)), gives: times },
    moving_sphere_box: { answer: (q) => cast(q, box(q.box)), gives: times },
    moving_sphere_capsule: { answer: (q) => cast(q, capsule(q.capsule)), gives: times },
    moving_sphere_triangle: { answer: (q) => cast(q, triangle(q.triangle)), gives: times },
    moving_sphere_plane: { answer: (q) => cast(q, plane(q.plane)), gives: times, declares: [declared("start in contact is a hit", stops)] },
    closest_point_segment: (q) => ({ point: projection(q.point, segment(q.segment)).point2 }),
    point_sphere_signed_distance: { answer: (q) => projection(q.point, sphere(q.sphere)), gives: points },
    point_segment_signed_distance: { answer: (q) => projection(q.point, segment(q.segment)), gives: points },
    point_capsule_signed_distance: { answer: (q) => projection(q.point, capsule(q.capsule)), gives: points },
    sphere_sphere_signed_distance: (q) => distance(sphere(q.sphere1), sphere(q.sphere2)),
    sphere_segment_signed_distance: (q) => distance(sphere(q.sphere), segment(q.segment)),
    sphere_capsule_signed_distance: (q) => distance(sphere(q.sphere), capsule(q.capsule)),
    segment_segment_signed_distance: (q) => distance(segment(q.segment1), segment(q.segment2)),
    segment_capsule_signed_distance: (q) => distance(segment(q.segment), capsule(q.capsule)),
    capsule_capsule_signed_distance: (q) => distance(capsule(q.capsule1), capsule(q.capsule2)),
  },
});
