// three-mesh-bvh: its ExtendedTriangle and OrientedBox, with the classes of three.
import path from "node:path";
import { pathToFileURL } from "node:url";
import { answerBy, load, packaged, turned } from "../engine.mjs";

const { version, library: B } = await load("three-mesh-bvh", "src/index.js");
const T = await import(pathToFileURL(path.join(path.dirname(packaged("three").file), "three.module.js")));
const vec = (v) => new T.Vector3(...v);

// Shapes.
const sphere = ({ center, radius }) => new T.Sphere(vec(center), radius);
const triangle = ({ v0, v1, v2 }) => new B.ExtendedTriangle(vec(v0), vec(v1), vec(v2));
const box = ({ center, half, orientation }) => {
  const made = new B.OrientedBox();  // `set` has the box computed; its constructor has not
  made.set(vec(half).negate(), vec(half), new T.Matrix4().compose(vec(center), new T.Quaternion(...turned(orientation)), new T.Vector3(1, 1, 1)));
  return made;
};
const segment = (a, b) => new T.Line3(vec(a), vec(b));

/** Whether a distance of the library is no more than `reach`. */
const near = (how, of, reach) => ({ answer: (q) => of(q) <= reach(q), by_equivalence: true, how });
answerBy({
  name: "three-mesh-bvh", version: `three-mesh-bvh ${version}`, scalar: "double",
  queries: {
    sphere_triangle_overlap: (q) => triangle(q.triangle).intersectsSphere(sphere(q.sphere)),
    triangle_triangle_overlap: (q) => triangle(q.triangle1).intersectsTriangle(triangle(q.triangle2)),
    triangle_box_overlap: (q) => box(q.box).intersectsTriangle(triangle(q.triangle)),
    capsule_triangle_overlap: near("ExtendedTriangle.closestPointToSegment", (q) => triangle(q.triangle).closestPointToSegment(segment(q.capsule.p0, q.capsule.p1)), (q) => q.capsule.radius),
    sphere_box_overlap: near("OrientedBox.distanceToPoint", (q) => box(q.box).distanceToPoint(vec(q.sphere.center)), (q) => q.sphere.radius),
  },
});
