// three: Ray, Box3, OBB, Line3 and Triangle of its math, and Octree and Capsule of its examples.
import { Cannot } from "../../program/nearmiss.mjs";
import { answerBy, declared, length, load, named, plus, turned, unit } from "../engine.mjs";

const { version, library: T } = await load("three");
const { library: { OBB } } = await load("three/examples/jsm/math/OBB.js");
const { library: { Octree } } = await load("three/examples/jsm/math/Octree.js");
const { library: { Capsule } } = await load("three/examples/jsm/math/Capsule.js");
const vec = (v) => new T.Vector3(...v);
const list = (v) => [v.x, v.y, v.z];

// Shapes.
const sphere = ({ center, radius }) => new T.Sphere(vec(center), radius);
const line = ({ v0, v1 }) => new T.Line3(vec(v0), vec(v1)), axis = ({ p0, p1 }) => new T.Line3(vec(p0), vec(p1));
const box3 = ({ min, max }) => new T.Box3(vec(min), vec(max));
const triangle = ({ v0, v1, v2 }) => new T.Triangle(vec(v0), vec(v1), vec(v2));
const plane = ({ normal, offset }) => new T.Plane(vec(normal), offset).normalize();
const obb = ({ center, half, orientation }) =>
  new OBB(vec(center), vec(half), new T.Matrix3().setFromMatrix4(new T.Matrix4().makeRotationFromQuaternion(new T.Quaternion(...turned(orientation)))));

// Calls: three's rays have a direction of length 1, and give the place.
function place(point, direction, ask) {
  if (!(length(direction) > 0)) return new Cannot("a ray has a direction");
  const r = new T.Ray(vec(point), vec(unit(direction))), found = new T.Vector3();
  return ask(r, found) !== null && { time: found.distanceTo(r.origin) / length(direction), location: list(found) };
}
const ray = ({ point, velocity }, ask) => place(point, velocity, ask);
function wayMeetsBox({ sphere: { center, radius }, velocity, box, limit, forever }) {  // of an axis-aligned box, with the sphere's way as a capsule
  const [x, y, z] = box.orientation;
  if (x || y || z || forever) return new Cannot("a turned box, or a way without end");
  const way = new Capsule(vec(center), vec(plus(center, velocity, limit)), radius);
  return way.intersectsBox(box3({ min: plus(box.center, box.half, -1), max: plus(box.center, box.half) }));
}

/** Whether a point, or two lines, are no further apart than `reach`. */
const near = (of, reach) => (q) => of(q) <= reach(q);
const toPoint = (segment, point) => segment.closestPointToPoint(point, true, new T.Vector3()).distanceTo(point);
const toLine = (a, b) => Math.sqrt(a.distanceSqToLine3(b));

const exit = "Ray.js: 'the ray is inside the sphere, so return the second exit point scaled by t1, in order to always return an intersect point that is in front of the ray'; of boxes: 'return point closest to the ray (positive side)'";
const leaves = [declared("contact where it leaves", exit)];
const gives = ["time", "location"], byDistance = { by_equivalence: true, how: "a distance of Line3, and the radii" };
answerBy({
  name: named("three"), version: `three ${version}`, scalar: "double",
  queries: {
    moving_point_sphere: { answer: (q) => ray(q, (r, p) => r.intersectSphere(sphere(q.sphere), p)), gives, declares: leaves },
    moving_point_plane: {
      answer: (q) => ray(q, (r, p) => r.intersectPlane(plane(q.plane), p)), gives,
      declares: [declared("two-sided", "Ray.distanceToPlane: 'Computes the distance from the ray's origin to the given plane. Returns null if the ray does not intersect with the plane'")],
    },
    moving_point_triangle: { answer: (q) => ray(q, (r, p) => { const { a, b, c } = triangle(q.triangle); return r.intersectTriangle(a, b, c, true, p); }), gives },
    moving_point_box: { answer: (q) => ray(q, (r, p) => obb(q.box).intersectRay(r, p)), gives, declares: leaves },
    moving_point_aabox: { answer: (q) => ray(q, (r, p) => r.intersectBox(box3(q.aabox), p)), gives, declares: leaves },
    ray_aabox: {
      answer: ({ ray: { origin, direction }, aabox }) => {
        const hit = place(origin, direction, (r, p) => r.intersectBox(box3(aabox), p));
        return hit instanceof Cannot ? false : hit && { location: hit.location };
      }, gives: ["location"],
    },
    sphere_sphere_overlap: (q) => sphere(q.sphere1).intersectsSphere(sphere(q.sphere2)),
    point_sphere_overlap: (q) => sphere(q.sphere).containsPoint(vec(q.point)),
    point_box_overlap: (q) => obb(q.box).containsPoint(vec(q.point)),
    sphere_box_overlap: (q) => obb(q.box).intersectsSphere(sphere(q.sphere)),
    box_box_overlap: { answer: (q) => obb(q.box1).intersectsOBB(obb(q.box2)), gives: [] },
    sphere_triangle_overlap: (q) => !!new Octree().triangleSphereIntersect(sphere(q.sphere), triangle(q.triangle)),
    point_capsule_overlap: { answer: near((q) => toPoint(axis(q.capsule), vec(q.point)), (q) => q.capsule.radius), ...byDistance },
    sphere_segment_overlap: { answer: near((q) => toPoint(line(q.segment), vec(q.sphere.center)), (q) => q.sphere.radius), ...byDistance },
    sphere_capsule_overlap: { answer: near((q) => toPoint(axis(q.capsule), vec(q.sphere.center)), (q) => q.sphere.radius + q.capsule.radius), ...byDistance },
    segment_capsule_overlap: { answer: near((q) => toLine(line(q.segment), axis(q.capsule)), (q) => q.capsule.radius), ...byDistance },
    capsule_capsule_overlap: { answer: near((q) => toLine(axis(q.capsule1), axis(q.capsule2)), (q) => q.capsule1.radius + q.capsule2.radius), ...byDistance },
    capsule_triangle_overlap: ({ capsule: { p0, p1, radius }, triangle: t }) => !!new Octree().triangleCapsuleIntersect(new Capsule(vec(p0), vec(p1), radius), triangle(t)),
    point_sphere_signed_distance: { answer: (q) => ({ distance: sphere(q.sphere).distanceToPoint(vec(q.point)) }), gives: ["distance"] },
    point_segment_signed_distance: { answer: (q) => ({ point2: list(line(q.segment).closestPointToPoint(vec(q.point), true, new T.Vector3())) }), gives: ["point2"] },
    segment_segment_signed_distance: {
      answer: (q) => {
        const point1 = new T.Vector3(), point2 = new T.Vector3();
        const square = line(q.segment1).distanceSqToLine3(line(q.segment2), point1, point2);
        return { distance: Math.sqrt(square), point1: list(point1), point2: list(point2) };
      }, gives: ["distance", "point1", "point2"],
    },
    aabox_triangle_overlap: (q) => box3(q.box).intersectsTriangle(triangle(q.triangle)),
    moving_sphere_passes_box: wayMeetsBox,
    closest_point_segment: (q) => ({ point: list(line(q.segment).closestPointToPoint(vec(q.point), true, new T.Vector3())) }),
    point_in_triangle: (q) => {
      const t = triangle(q.triangle), p = vec(q.point), weights = t.getBarycoord(p, new T.Vector3());
      return t.containsPoint(p) && { weights: list(weights) };
    },
  },
});
