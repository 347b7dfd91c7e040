// PhysX: raycasts, sweeps, overlaps and distances of PxGeometryQuery, and PxGjkQuery.proximityInfo for depths. The setting strict
// has the flags of exact sweeps and of depths at their start. The package is built for browsers, and gets its WebAssembly file here.
import fs from "node:fs";
import { pathToFileURL } from "node:url";
import { Cannot } from "../../program/nearmiss.mjs";
import { answerBy, around, declared, declares, impactAt, length, minus, packaged, plus, scaled, setting, timeToPass, timeToPlane, turned, turnOf, unit } from "../engine.mjs";

const { version, file } = packaged("physx-js-webidl");
const { process } = globalThis;
Object.assign(globalThis, { window: globalThis, process: undefined });  // it asks for them while it is loaded
const { default: start } = await import(pathToFileURL(file));
const P = await start({ wasmBinary: fs.readFileSync(file.replace(".mjs", ".wasm")) });
Object.assign(globalThis, { window: undefined, process });

// Objects that every case sets anew, so that none is lost.
const set = (v, [x, y, z, w]) => {
  v.x = x, v.y = y, v.z = z;
  if (w !== undefined) v.w = w;
  return v;
};
const list = (v) => [v.x, v.y, v.z];
const Query = P.PxGeometryQuery.prototype;
const origin = new P.PxVec3(), direction = new P.PxVec3();
const raycastHit = new P.PxRaycastHit(), sweepHit = new P.PxSweepHit(), proximity = new P.PxGjkQueryProximityInfoResult();
const flags = new P.PxHitFlags(P.PxHitFlagEnum.eDEFAULT);
const isStrict = setting === "strict";
if (isStrict) flags.raise(P.PxHitFlagEnum.ePRECISE_SWEEP), flags.raise(P.PxHitFlagEnum.eMTD);
/** Two of each shape, one for each body: with its pose, and as a support where it has one. */
const bodies = [0, 1].map(() => {
  const pose = new P.PxTransform(P.PxIDENTITYEnum.PxIdentity);
  const at = (geometry, p, q, support) => (set(pose.p, p), set(pose.q, q), { geometry, pose, support });
  const ball = new P.PxSphereGeometry(1), box = new P.PxBoxGeometry(1, 1, 1), capsule = new P.PxCapsuleGeometry(1, 1), plane = new P.PxPlaneGeometry();
  const ballSupport = new P.SphereSupport(1), boxSupport = new P.BoxSupport(set(origin, [1, 1, 1])), capsuleSupport = new P.CapsuleSupport(1, 1);
  return {
    sphere: ({ center, radius }) => {
      ball.radius = ballSupport.radius = radius;
      return at(ball, center, [0, 0, 0, 1], ballSupport);
    },
    box: ({ center, half, orientation }) => {
      set(box.halfExtents, half), set(boxSupport.halfExtents, half);
      return at(box, center, turned(orientation), boxSupport);
    },
    capsule: ({ p0, p1, radius }) => {  // PhysX's capsules are along x
      const l = length(minus(p1, p0));
      capsule.radius = capsuleSupport.radius = radius, capsule.halfHeight = capsuleSupport.halfHeight = l / 2;
      return at(capsule, scaled(plus(p0, p1), 0.5), turnOf("x", l > 0 ? unit(minus(p1, p0)) : [1, 0, 0]), capsuleSupport);
    },
    plane: ({ normal, offset }) => at(plane, scaled(unit(normal), -offset / length(normal)), turnOf("x", unit(normal))),
  };
});
const [first, second] = bodies;

// A triangle is a mesh of one.
const Make = P.PxTopLevelFunctions.prototype;
Make.CreateFoundation(Make.PHYSICS_VERSION, new P.PxDefaultAllocator(), new P.PxDefaultErrorCallback());
const cooking = new P.PxCookingParams(new P.PxTolerancesScale()), mesh = new P.PxTriangleMeshDesc();
const corners = P._webidl_malloc(36), indices = P._webidl_malloc(12);
Object.assign(mesh.points, { count: 3, stride: 12, data: P.wrapPointer(corners, P.VoidPtr) });
Object.assign(mesh.triangles, { count: 1, stride: 12, data: P.wrapPointer(indices, P.VoidPtr) });
P.HEAPU32.set([0, 1, 2], indices / 4);
const still = new P.PxTransform(P.PxIDENTITYEnum.PxIdentity);
function withTriangle({ v0, v1, v2 }, ask) {
  new Float32Array(P.HEAPU32.buffer, corners, 9).set([...v0, ...v1, ...v2]);
  const cooked = Make.CreateTriangleMesh(cooking, mesh);
  if (P.getPointer(cooked) === 0) return new Cannot("PxCreateTriangleMesh refuses the triangle");
  const geometry = new P.PxTriangleMeshGeometry(cooked);
  const answer = ask({ geometry, pose: still, isSurface: true });
  P.destroy(geometry), cooked.release();
  return answer;
}

// Calls.
const noGeometry = (body) => !Query.isValid(body.geometry);
const refused = new Cannot("PxGeometryQuery::isValid says that the shape is not valid");
function ray({ point, velocity }, body, horizon) {
  if (horizon === 0) return new Cannot("a ray has a direction");
  if (noGeometry(body)) return refused;
  const hits = Query.raycast(set(origin, point), set(direction, unit(velocity)), body.geometry, body.pose, horizon * length(velocity), flags, 1, raycastHit);
  if (hits === 0) return false;
  // From inside, the normal is only the direction reversed. A triangle has no inside.
  const isInside = declares && raycastHit.distance === 0 && !body.isSurface;
  return impactAt(raycastHit.distance / length(velocity), { location: list(raycastHit.position), normal: isInside ? null : list(raycastHit.normal) });
}
const rayTo = (shape) => (q) => ray(q, first[shape](q[shape]), timeToPass(q.point, q.velocity, ...around[shape](q[shape])));
const rayToTriangle = (q) => withTriangle(q.triangle, (body) => ray(q, body, timeToPass(q.point, q.velocity, ...around.triangle(q.triangle))));
const rayToPlane = (q) => ray(q, first.plane(q.plane), timeToPlane(q.point, q.velocity, q.plane));
function sweep({ sphere, velocity }, body, horizon) {
  if (horizon === 0) return new Cannot("a sweep has a direction");
  const moving = first.sphere(sphere), speed = length(velocity);
  if (noGeometry(moving) || noGeometry(body)) return refused;
  const hit = Query.sweep(set(direction, unit(velocity)), horizon * speed, moving.geometry, moving.pose, body.geometry, body.pose, sweepHit, flags, 0);
  if (!hit) return false;
  const time = Math.max(sweepHit.distance, 0) / speed;  // with eMTD it is minus the depth where they overlap at the start
  // It flags the position as missing where they overlap at the start without eMTD; the normal is then only the opposite direction.
  return impactAt(time, sweepHit.flags.isSet(P.PxHitFlagEnum.ePOSITION) && { location: list(sweepHit.position), normal: list(sweepHit.normal) });
}
const sweepPast = (q, body, [center, radius]) => sweep(q, body, timeToPass(q.sphere.center, q.velocity, center, radius + q.sphere.radius));
const sweepTo = (shape, member = shape) => (q) => sweepPast(q, second[shape](q[member]), around[shape](q[member]));
const sweepToTriangle = (q) => withTriangle(q.triangle, (body) => sweepPast(q, body, around.triangle(q.triangle)));
const sweepToPlane = (q) => sweep(q, second.plane(q.plane), timeToPlane(q.sphere.center, q.velocity, q.plane, q.sphere.radius));
function meet(a, b) {
  if (noGeometry(a) || noGeometry(b)) return refused;
  return Query.overlap(a.geometry, a.pose, b.geometry, b.pose);
}
const meetTriangle = (body, triangle) => withTriangle(triangle, (other) => meet(body, other));
function contains(body, point) {
  if (noGeometry(body)) return refused;
  return Query.pointDistance(set(origin, point), body.geometry, body.pose) === 0;
}
function depth(a, b) {
  if (noGeometry(a) || noGeometry(b)) return refused;
  const found = P.PxGjkQuery.prototype.proximityInfo(a.support, b.support, a.pose, b.pose, 0, 1, proximity);
  return found && proximity.separation <= 0 && { depth: -proximity.separation, normal: scaled(list(proximity.separatingAxis), -1) };
}
/** The signed distance of two shapes with a radius, which may be 0. */
function distance(a, b) {
  const reach = 2 * length(minus(list(b.pose.p), list(a.pose.p)));
  if (!P.PxGjkQuery.prototype.proximityInfo(a.support, b.support, a.pose, b.pose, reach, 1, proximity)) return new Cannot("proximityInfo finds no nearest points");
  return { distance: proximity.separation, normal: scaled(list(proximity.separatingAxis), -1), point1: list(proximity.pointA), point2: list(proximity.pointB) };
}
/** Whether two supports meet, which may have a radius of 0. */
const coresMeet = (a, b) => P.PxGjkQuery.prototype.overlap(a.support, b.support, a.pose, b.pose);
const ballAt = (center) => ({ center, radius: 0 }), rod = ({ v0, v1 }) => ({ p0: v0, p1: v1, radius: 0 });

const inside = [declared("start in contact is a hit", "Geometry Queries, Raycasts against Spheres, Capsules, Boxes and Convex Meshes: 'If the ray origin is inside a solid object: the reported hit distance is set to zero', 'the hit normal is set to be the opposite of the ray's direction'")];
const overlapping = [declared("start in contact is a hit", "PxScene::sweep: 'If a shape from the scene is already overlapping with the query shape in its starting position, the hit is returned unless eASSUME_NO_INITIAL_OVERLAP was specified.'")];
const gives = ["depth", "normal"];
const holds = (shape) => (q) => contains(first[shape](q[shape]), q.point);
const byDistance = { how: "PxGeometryQuery::pointDistance is 0", by_equivalence: true };
answerBy({
  name: "physx", version: `PhysX 5.6.1, physx-js-webidl ${version}`, scalar: "float",
  queries: {
    moving_point_sphere: { answer: rayTo("sphere"), declares: inside },
    moving_point_box: { answer: rayTo("box"), declares: inside },
    moving_point_capsule: { answer: rayTo("capsule"), declares: inside },
    moving_point_plane: rayToPlane,
    moving_point_triangle: rayToTriangle,
    moving_sphere_sphere: { answer: sweepTo("sphere", "fixed"), declares: overlapping },
    moving_sphere_box: { answer: sweepTo("box"), declares: overlapping },
    moving_sphere_capsule: { answer: sweepTo("capsule"), declares: overlapping },
    moving_sphere_plane: { answer: sweepToPlane, declares: overlapping },
    moving_sphere_triangle: { answer: sweepToTriangle, gives: ["time", "location", "normal"] },
    sphere_sphere_overlap: (q) => meet(first.sphere(q.sphere1), second.sphere(q.sphere2)),
    sphere_box_overlap: (q) => meet(first.sphere(q.sphere), second.box(q.box)),
    sphere_triangle_overlap: (q) => meetTriangle(first.sphere(q.sphere), q.triangle),
    point_sphere_overlap: { answer: holds("sphere"), ...byDistance },
    point_capsule_overlap: { answer: holds("capsule"), ...byDistance },
    point_box_overlap: { answer: holds("box"), ...byDistance },
    sphere_segment_overlap: (q) => coresMeet(first.sphere(q.sphere), second.capsule(rod(q.segment))),
    segment_capsule_overlap: (q) => coresMeet(first.capsule(rod(q.segment)), second.capsule(q.capsule)),
    segment_box_overlap: (q) => coresMeet(first.capsule(rod(q.segment)), second.box(q.box)),
    sphere_capsule_overlap: (q) => meet(first.sphere(q.sphere), second.capsule(q.capsule)),
    capsule_capsule_overlap: (q) => meet(first.capsule(q.capsule1), second.capsule(q.capsule2)),
    capsule_triangle_overlap: (q) => meetTriangle(first.capsule(q.capsule), q.triangle),
    capsule_box_overlap: (q) => meet(first.capsule(q.capsule), second.box(q.box)),
    triangle_box_overlap: (q) => meetTriangle(first.box(q.box), q.triangle),
    box_box_overlap: { answer: (q) => meet(first.box(q.box1), second.box(q.box2)), gives: [] },
    sphere_sphere_penetration: { answer: (q) => depth(first.sphere(q.sphere1), second.sphere(q.sphere2)), gives },
    sphere_box_penetration: { answer: (q) => depth(first.sphere(q.sphere), second.box(q.box)), gives },
    box_box_penetration: { answer: (q) => depth(first.box(q.box1), second.box(q.box2)), gives },
    point_sphere_signed_distance: (q) => distance(first.sphere(ballAt(q.point)), second.sphere(q.sphere)),
    point_segment_signed_distance: (q) => distance(first.sphere(ballAt(q.point)), second.capsule(rod(q.segment))),
    point_capsule_signed_distance: (q) => distance(first.sphere(ballAt(q.point)), second.capsule(q.capsule)),
    sphere_sphere_signed_distance: (q) => distance(first.sphere(q.sphere1), second.sphere(q.sphere2)),
    sphere_segment_signed_distance: (q) => distance(first.sphere(q.sphere), second.capsule(rod(q.segment))),
    sphere_capsule_signed_distance: (q) => distance(first.sphere(q.sphere), second.capsule(q.capsule)),
    segment_segment_signed_distance: (q) => distance(first.capsule(rod(q.segment1)), second.capsule(rod(q.segment2))),
    segment_capsule_signed_distance: (q) => distance(first.capsule(rod(q.segment)), second.capsule(q.capsule)),
    capsule_capsule_signed_distance: (q) => distance(first.capsule(q.capsule1), second.capsule(q.capsule2)),
  },
});
