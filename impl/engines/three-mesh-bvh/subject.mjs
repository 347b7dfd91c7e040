// three-mesh-bvh: its ExtendedTriangle and OrientedBox, with the classes of three.
import { answerBy, load, turned } from "../engine.mjs";

const { version, library: B } = await load("three-mesh-bvh");
const { library: T } = await load("three");
const vec = (v) => new T.Vector3(...v);

// Shapes.
const sphere = ({ center, radius }) => new T.Sphere(vec(center), radius);
const triangle = ({ v0, v1, v2 }) => new B.ExtendedTriangle(vec(v0), vec(v1), vec(v2));
const pose = ({ center, orientation }) => new T.Matrix4().compose(vec(center), new T.Quaternion(...turned(orientation)), new T.Vector3(1, 1, 1));
const oriented = (half, matrix) => {
  const made = new B.OrientedBox();  // `set` has the box computed; its constructor has not
  made.set(vec(half).negate(), vec(half), matrix);
  return made;
};
const box = (b) => oriented(b.half, pose(b));
const segment = (a, b) => new T.Line3(vec(a), vec(b));

/** The first box in the frame of the second, because OrientedBox meets boxes that are axis-aligned. */
const boxesMeet = ({ box1, box2 }) =>
  oriented(box1.half, pose(box2).invert().multiply(pose(box1))).intersectsBox(new T.Box3(vec(box2.half).negate(), vec(box2.half)));
/** Whether a distance of the library is no more than `reach`. */
const near = (of, reach) => (q) => of(q) <= reach(q);
const by = (how) => ({ by_equivalence: true, how });
answerBy({
  name: "three-mesh-bvh", version: `three-mesh-bvh ${version}`, scalar: "double",
  queries: {
    sphere_triangle_overlap: (q) => triangle(q.triangle).intersectsSphere(sphere(q.sphere)),
    triangle_triangle_overlap: (q) => triangle(q.triangle1).intersectsTriangle(triangle(q.triangle2)),
    triangle_box_overlap: (q) => box(q.box).intersectsTriangle(triangle(q.triangle)),
    capsule_triangle_overlap: { answer: near((q) => triangle(q.triangle).closestPointToSegment(segment(q.capsule.p0, q.capsule.p1)), (q) => q.capsule.radius), ...by("ExtendedTriangle.closestPointToSegment") },
    box_box_overlap: { answer: boxesMeet, gives: [], ...by("OrientedBox.intersectsBox, in the frame of the second box") },
    sphere_box_overlap: { answer: near((q) => box(q.box).distanceToPoint(vec(q.sphere.center)), (q) => q.sphere.radius), ...by("OrientedBox.distanceToPoint") },
  },
});
