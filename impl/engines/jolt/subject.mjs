// Jolt: rays, collisions and casts of its shapes, by TransformedShape. The convex radius of boxes is zero. The setting strict
// takes the least tolerances that floats can have, and the deepest point of bodies that overlap at the start of a cast.
import { Cannot } from "../../program/nearmiss.mjs";
import { answerBy, around, declared, exactWay, impactAt, length, load, minus, plus, scaled, setting, timeToPass, timeToPlane, turned, turnOf, unit } from "../engine.mjs";

const { version, library } = await load("jolt-physics");
const J = await library.default();
const settings = new J.JoltSettings(), pairs = new J.ObjectLayerPairFilterTable(1), layers = new J.BroadPhaseLayerInterfaceTable(1, 1);
layers.MapObjectToBroadPhaseLayer(0, new J.BroadPhaseLayer(0));
settings.mObjectLayerPairFilter = pairs, settings.mBroadPhaseLayerInterface = layers;
settings.mObjectVsBroadPhaseLayerFilter = new J.ObjectVsBroadPhaseLayerFilterTable(layers, 1, pairs, 1);
new J.JoltInterface(settings);  // registers the shapes

// Objects of a case, which are destroyed after it.
const kept = [];
const keep = (object) => (kept.push(object), object);
const freeing = (answer) => {
  while (kept.length) J.destroy(kept.pop());
  return answer;
};
const vec = (v) => keep(new J.Vec3(...v)), rvec = (v) => keep(new J.RVec3(...v)), quat = (q) => keep(new J.Quat(...q));
const list = (v) => [v.GetX(), v.GetY(), v.GetZ()];

// Shapes, each with its place.
const still = [0, 0, 0, 1];
const sphere = ({ center, radius }) => ({ shape: new J.SphereShape(radius), at: center, turn: still });
const box = ({ center, half, orientation }) => ({ shape: new J.BoxShape(vec(half), 0), at: center, turn: turned(orientation) });
const capsule = ({ p0, p1, radius }) => {  // Jolt's capsules are along y
  const l = length(minus(p1, p0));
  if (!(l > 0)) return sphere({ center: p0, radius });
  return { shape: new J.CapsuleShape(l / 2, radius), at: scaled(plus(p0, p1), 0.5), turn: turnOf("y", unit(minus(p1, p0))) };
};
const plane = ({ normal, offset }) => ({ shape: new J.PlaneShape(keep(new J.Plane(vec(unit(normal)), offset / length(normal)))), at: [0, 0, 0], turn: still });
const triangle = ({ v0, v1, v2 }) => {  // a mesh, whose corners Jolt stores with 21 bits for each coordinate of their bounds
  const triangles = keep(new J.TriangleList());
  triangles.push_back(keep(new J.Triangle(vec(v0), vec(v1), vec(v2))));
  const made = keep(new J.MeshShapeSettings(triangles)).Create();
  if (made.HasError()) throw new Cannot(`MeshShapeSettings::Create: ${made.GetError().c_str()}`);
  return { shape: made.Get(), at: [0, 0, 0], turn: still };
};
const placed = ({ shape, at, turn }) => {
  shape.AddRef();
  return shape.GetSubShapeTransformedShape(keep(new J.SubShapeID()), vec(at), quat(turn), vec([1, 1, 1]), keep(new J.SubShapeID()));
};

// Calls.
const anyShape = new J.ShapeFilter(), zero = new J.RVec3(0, 0, 0);
const isStrict = setting === "strict", leastTolerance = 2 ** -23;
const settled = (how) => (isStrict ? Object.assign(how, { mCollisionTolerance: leastTolerance, mPenetrationTolerance: leastTolerance }) : how);
/** Where a ray from a point along a way meets what `make` makes, from 0 to 1, or more where it does not: of a triangle both sides. */
function fractionOf(point, way, make) {
  const b = make(), hit = keep(new J.RayCastResult());
  placed(b).CastRay(keep(new J.RRayCast(rvec(point), vec(way))), hit);
  const fraction = hit.mFraction;
  b.shape.Release();
  return freeing(fraction);
}
/** The same with the usual settings of rays, which ignore the backs of triangles. */
function fractionAtFront(point, way, make) {
  const b = make(), collector = keep(new J.CastRayClosestHitCollisionCollector());
  placed(b).CastRay(keep(new J.RRayCast(rvec(point), vec(way))), keep(new J.RayCastSettings()), collector, anyShape);
  const fraction = collector.HadHit() ? collector.mHit.mFraction : 2;
  b.shape.Release();
  return freeing(fraction);
}
/** A ray to what `make` makes, which it has passed at the time `horizon`. */
function ray({ point, velocity }, make, horizon, ask = fractionOf) {
  if (horizon === 0) return new Cannot("a ray has two ends");
  const fraction = ask(point, scaled(velocity, horizon), make);
  return fraction <= 1 && impactAt(fraction * horizon);
}
const rayTo = (make, shape, ask) => (q) => ray(q, () => make(q[shape]), timeToPass(q.point, q.velocity, ...around[shape](q[shape])), ask);
/** A cast of the moving sphere against what `make` makes, which it has passed at the time `horizon`. */
function cast({ sphere: moving, velocity }, make, horizon) {
  if (horizon === 0) return new Cannot("a cast has two ends");
  const a = sphere(moving), b = make();
  a.shape.AddRef();
  const pose = J.RMat44.prototype.sRotationTranslation(quat(a.turn), rvec(a.at));
  const way = keep(new J.RShapeCast(a.shape, vec([1, 1, 1]), pose, vec(scaled(velocity, horizon))));
  const collector = keep(new J.CastShapeClosestHitCollisionCollector()), how = settled(keep(new J.ShapeCastSettings()));
  how.mReturnDeepestPoint = isStrict;
  how.mBackFaceModeConvex = J.EBackFaceMode_CollideWithBackFaces;  // also hits where it starts inside and leaves
  placed(b).CastShape(way, how, zero, collector, anyShape);
  const { mFraction, mContactPointOn2, mPenetrationAxis } = collector.mHit;
  // Where they overlap at the start it computes the deepest point only on request.
  const contact = (mFraction > 0 || isStrict) && { location: list(mContactPointOn2), normal: scaled(unit(list(mPenetrationAxis)), -1) };
  const hit = collector.HadHit() && impactAt(mFraction * horizon, contact);
  a.shape.Release(), b.shape.Release();
  return freeing(hit);
}
const castTo = (make, shape, member = shape) => (q) => {
  const [center, radius] = around[shape](q[member]);
  return cast(q, () => make(q[member]), timeToPass(q.sphere.center, q.velocity, center, radius + q.sphere.radius));
};
/** What `read` makes of the deepest hit of two shapes, or of the nearest points within `reach`; false without a hit. */
function collision(a, b, read = ({ mPenetrationDepth, mPenetrationAxis }) => ({ depth: mPenetrationDepth, normal: unit(list(mPenetrationAxis)) }), reach = 0) {
  const how = settled(keep(new J.CollideShapeSettings())), collector = keep(new J.CollideShapeClosestHitCollisionCollector());
  how.mMaxSeparationDistance = reach;
  how.mBackFaceMode = J.EBackFaceMode_CollideWithBackFaces;  // triangles have two sides
  a.shape.AddRef();
  const pose = J.RMat44.prototype.sRotationTranslation(quat(a.turn), rvec(a.at));
  placed(b).CollideShape(a.shape, vec([1, 1, 1]), pose, how, zero, collector, anyShape);
  const hit = collector.HadHit() && read(collector.mHit);
  a.shape.Release(), b.shape.Release();
  return freeing(hit);
}
const meet = (a, b) => collision(a, b) !== false;
/** The signed distance of two shapes, whose nearest points are no further apart than their places. */
function distance(a, b) {
  const found = collision(a, b, ({ mPenetrationDepth, mPenetrationAxis, mContactPointOn1, mContactPointOn2 }) => ({
    distance: -mPenetrationDepth, normal: unit(list(mPenetrationAxis)), point1: list(mContactPointOn1), point2: list(mContactPointOn2),
  }), 2 * length(minus(b.at, a.at)));
  return found || new Cannot("CollideShape finds no nearest points");
}
function contains(b, point) {
  const collector = keep(new J.CollidePointAnyHitCollisionCollector());
  placed(b).CollidePoint(rvec(point), collector, anyShape);
  const found = collector.HadHit();
  b.shape.Release();
  return freeing(found);
}
/** Whether a segment meets what `make` makes, by a ray from its one end to the other. */
function reaches({ v0, v1 }, make) {
  const way = exactWay(v0, v1);
  if (!way) return new Cannot("a ray has a start and a way, and floats do not hold the way between the ends");
  if (!(length(way) > 0)) return new Cannot("a ray has two ends");
  return fractionOf(v0, way, make) <= 1;
}

const solid = [declared("start in contact is a hit",
  "RayCastSettings::mTreatConvexAsSolid: 'If convex shapes should be treated as solid. When true, a ray starting inside a convex shape will generate a hit at fraction 0.'")];
const halfSpace = [declared("start in contact is a hit", "PlaneShape: 'A plane shape. The negative half space is considered solid.'")];
const rays = { gives: ["time"], declares: solid }, gives = ["depth", "normal"];
answerBy({
  name: "jolt", version: `jolt-physics ${version}`, scalar: "float",
  queries: {
    moving_point_sphere: { answer: rayTo(sphere, "sphere"), ...rays },
    moving_point_box: { answer: rayTo(box, "box"), ...rays },
    moving_point_capsule: { answer: rayTo(capsule, "capsule"), ...rays },
    moving_point_plane: { answer: (q) => ray(q, () => plane(q.plane), timeToPlane(q.point, q.velocity, q.plane)), gives: ["time"], declares: halfSpace },
    moving_point_triangle: { answer: rayTo(triangle, "triangle", fractionAtFront), gives: ["time"] },
    moving_sphere_sphere: castTo(sphere, "sphere", "fixed"),
    moving_sphere_box: castTo(box, "box"),
    moving_sphere_capsule: castTo(capsule, "capsule"),
    moving_sphere_triangle: { answer: castTo(triangle, "triangle"), gives: ["time", "location", "normal"] },
    moving_sphere_plane: {
      answer: (q) => cast(q, () => plane(q.plane), timeToPlane(q.sphere.center, q.velocity, q.plane, q.sphere.radius)), declares: halfSpace,
    },
    sphere_sphere_overlap: (q) => meet(sphere(q.sphere1), sphere(q.sphere2)),
    sphere_box_overlap: (q) => meet(sphere(q.sphere), box(q.box)),
    sphere_triangle_overlap: (q) => meet(sphere(q.sphere), triangle(q.triangle)),
    point_sphere_overlap: (q) => contains(sphere(q.sphere), q.point),
    point_capsule_overlap: (q) => contains(capsule(q.capsule), q.point),
    point_box_overlap: (q) => contains(box(q.box), q.point),
    sphere_segment_overlap: (q) => reaches(q.segment, () => sphere(q.sphere)),
    segment_capsule_overlap: (q) => reaches(q.segment, () => capsule(q.capsule)),
    segment_triangle_overlap: (q) => reaches(q.segment, () => triangle(q.triangle)),
    segment_box_overlap: (q) => reaches(q.segment, () => box(q.box)),
    sphere_capsule_overlap: (q) => meet(sphere(q.sphere), capsule(q.capsule)),
    capsule_capsule_overlap: (q) => meet(capsule(q.capsule1), capsule(q.capsule2)),
    capsule_triangle_overlap: (q) => meet(capsule(q.capsule), triangle(q.triangle)),
    capsule_box_overlap: (q) => meet(capsule(q.capsule), box(q.box)),
    triangle_box_overlap: (q) => meet(box(q.box), triangle(q.triangle)),
    box_box_overlap: { answer: (q) => meet(box(q.box1), box(q.box2)), gives: [] },
    sphere_sphere_penetration: { answer: (q) => collision(sphere(q.sphere1), sphere(q.sphere2)), gives },
    sphere_box_penetration: { answer: (q) => collision(sphere(q.sphere), box(q.box)), gives },
    sphere_plane_penetration: {
      answer: (q) => {
        const hit = collision(sphere(q.sphere), plane(q.plane));
        return hit && { depth: hit.depth, normal: scaled(hit.normal, -1) };
      }, gives,
    },
    box_box_penetration: { answer: (q) => collision(box(q.box1), box(q.box2)), gives },
    sphere_sphere_signed_distance: (q) => distance(sphere(q.sphere1), sphere(q.sphere2)),
    sphere_capsule_signed_distance: (q) => distance(sphere(q.sphere), capsule(q.capsule)),
    capsule_capsule_signed_distance: (q) => distance(capsule(q.capsule1), capsule(q.capsule2)),
  },
});
