// Havok: ray casts, shape casts, and the proximity of shapes and points, against one body in a world.
import fs from "node:fs";
import { Cannot } from "../../program/nearmiss.mjs";
import { answerBy, around, length, load, minus, packaged, plus, scaled, timeToPass, turned } from "../engine.mjs";

const { version, library } = await load("@babylonjs/havok");
const H = await library.default({ wasmBinary: fs.readFileSync(packaged("@babylonjs/havok/lib/esm/HavokPhysics.wasm").file) });
const [, world] = H.HP_World_Create(), [, body] = H.HP_Body_Create(), [, hits] = H.HP_QueryCollector_Create(1);
H.HP_Body_SetMotionType(body, H.MotionType.STATIC);

// Shapes, each with its place. They are released after the case.
const kept = [];
const made = ([result, shape]) => {
  if (result.value !== H.Result.RESULT_OK.value) throw new Cannot("HP_Shape_Create refuses the shape");
  kept.push(shape);
  return shape;
};
const releasing = (answer) => (q) => {
  try {
    return answer(q);
  } finally {
    while (kept.length) H.HP_Shape_Release(kept.pop());
  }
};
const still = [0, 0, 0, 1], center = [0, 0, 0];
const sphere = ({ center: at, radius }) => ({ shape: made(H.HP_Shape_CreateSphere(center, radius)), at, turn: still });
const box = ({ center: at, half, orientation }) => ({ shape: made(H.HP_Shape_CreateBox(center, still, scaled(half, 2))), at, turn: turned(orientation) });
const capsule = ({ p0, p1, radius }) => {
  const at = scaled(plus(p0, p1), 0.5);
  return { shape: made(H.HP_Shape_CreateCapsule(minus(p0, at), minus(p1, at), radius)), at, turn: still };
};
const vertices = H._malloc(36), indices = H._malloc(12);
const triangle = ({ v0, v1, v2 }) => {
  H.HEAPF32.set([...v0, ...v1, ...v2], vertices / 4), H.HEAP32.set([0, 1, 2], indices / 4);
  return { shape: made(H.HP_Shape_CreateMesh(vertices, 3, indices, 1)), at: center, turn: still };
};

/** The hull of the ends of a segment or of the corners of a triangle. Havok has no proximity of two meshes. */
const hull = (...points) => {
  H.HEAPF32.set(points.flat(), vertices / 4);
  return { shape: made(H.HP_Shape_CreateConvexHull(vertices, points.length)), at: center, turn: still };
};
const segmentHull = ({ v0, v1 }) => hull(v0, v1), triangleHull = ({ v0, v1, v2 }) => hull(v0, v1, v2);

// Calls. A world is asked about one body; a hit is the fraction or the distance, then points of contact, each with its
// place and normal.
const place = 3, normal = 4;
const noBody = [0n], everything = [-1, -1], triggers = false;
/** The first hit of a query against this body alone; null where there is none. */
function against({ shape, at, turn }, ask, read) {
  H.HP_Body_SetShape(body, shape), H.HP_Body_SetQTransform(body, [at, turn]), H.HP_World_AddBody(world, body, false);
  ask();
  const [, count] = H.HP_QueryCollector_GetNumHits(hits), hit = count > 0 ? read(hits, 0)[1] : null;
  H.HP_World_RemoveBody(world, body);
  H.HP_World_Step(world, 1 / 60);  // until then the world remembers the body, which changes later answers and takes memory
  return hit;
}
function ray({ point, velocity }, target, [at, radius]) {
  const horizon = timeToPass(point, velocity, at, radius);
  if (horizon === 0) return new Cannot("a ray has two ends");
  const end = plus(point, velocity, horizon);
  const hit = against(target(), () => H.HP_World_CastRayWithCollector(world, hits, [point, end, everything, triggers, noBody]), H.HP_QueryCollector_GetCastRayResult);
  return hit && { time: hit[0] * horizon, location: hit[1][place], normal: hit[1][normal] };
}
function cast({ sphere: moving, velocity }, target, [at, radius]) {
  const horizon = timeToPass(moving.center, velocity, at, radius + moving.radius);
  if (horizon === 0) return new Cannot("a cast has two ends");
  const end = plus(moving.center, velocity, horizon), { shape } = sphere(moving);
  const hit = against(target(), () => H.HP_World_ShapeCastWithCollector(world, hits, [shape, still, moving.center, end, triggers, noBody]), H.HP_QueryCollector_GetShapeCastResult);
  return hit && { time: hit[0] * horizon, location: hit[2][place], normal: hit[2][normal] };
}
/** The proximity of two shapes within that distance: the distance and two points of contact. */
const proximity = (a, b, most = 0) =>
  against(b, () => H.HP_World_ShapeProximityWithCollector(world, hits, [a.shape, a.at, a.turn, most, triggers, noBody]), H.HP_QueryCollector_GetShapeProximityResult);
function overlap(a, b) {
  const hit = proximity(a, b);
  return hit && hit[0] <= 0 && { depth: -hit[0], normal: scaled(hit[2][normal], -1) };
}
const meet = (a, b) => !!overlap(a, b);
const pointProximity = (point, target, most = 0) =>
  against(target, () => H.HP_World_PointProximityWithCollector(world, hits, [point, most, everything, triggers, noBody]), H.HP_QueryCollector_GetPointProximityResult);
function contains(target, point) {
  const hit = pointProximity(point, target);
  return hit !== null && hit[0] <= 0;
}
/** The signed distance of two shapes, or of a point and a shape; the nearest points are no further apart than their places. */
function distanceOf(ask, a, b, at) {
  const hit = ask(a, b, 2 * length(minus(b.at, at)));
  if (!hit) return new Cannot("the proximity finds no nearest points");
  const contact = hit.at(-1);  // of the body in the world
  return { distance: hit[0], normal: scaled(contact[normal], -1), point2: contact[place] };
}
const distance = (a, b) => distanceOf(proximity, a, b, a.at);
const pointDistance = (point, b) => distanceOf(pointProximity, point, b, point);

// Babylon's page of the shape cast query: 'Result will not be correct for intersecting shapes'.
const requires = ["starts outside"];
const gives = ["depth", "normal"], distances = ["distance", "normal", "point2"];
const queries = {
  moving_point_sphere: (q) => ray(q, () => sphere(q.sphere), around.sphere(q.sphere)),
  moving_point_box: (q) => ray(q, () => box(q.box), around.box(q.box)),
  moving_point_capsule: (q) => ray(q, () => capsule(q.capsule), around.capsule(q.capsule)),
  moving_point_triangle: { answer: (q) => ray(q, () => triangle(q.triangle), around.triangle(q.triangle)), gives: ["time", "location", "normal"] },
  moving_sphere_sphere: { answer: (q) => cast(q, () => sphere(q.fixed), around.sphere(q.fixed)), requires },
  moving_sphere_box: { answer: (q) => cast(q, () => box(q.box), around.box(q.box)), requires },
  moving_sphere_capsule: { answer: (q) => cast(q, () => capsule(q.capsule), around.capsule(q.capsule)), requires },
  moving_sphere_triangle: { answer: (q) => cast(q, () => triangle(q.triangle), around.triangle(q.triangle)), gives: ["time", "location", "normal"], requires },
  sphere_sphere_overlap: (q) => meet(sphere(q.sphere1), sphere(q.sphere2)),
  sphere_box_overlap: (q) => meet(sphere(q.sphere), box(q.box)),
  sphere_triangle_overlap: (q) => meet(sphere(q.sphere), triangle(q.triangle)),
  point_sphere_overlap: (q) => contains(sphere(q.sphere), q.point),
  point_capsule_overlap: (q) => contains(capsule(q.capsule), q.point),
  point_box_overlap: (q) => contains(box(q.box), q.point),
  sphere_segment_overlap: (q) => meet(sphere(q.sphere), segmentHull(q.segment)),
  segment_capsule_overlap: (q) => meet(capsule(q.capsule), segmentHull(q.segment)),
  segment_triangle_overlap: (q) => meet(segmentHull(q.segment), triangle(q.triangle)),
  segment_box_overlap: (q) => meet(box(q.box), segmentHull(q.segment)),
  triangle_triangle_overlap: (q) => meet(triangleHull(q.triangle1), triangle(q.triangle2)),
  sphere_capsule_overlap: (q) => meet(sphere(q.sphere), capsule(q.capsule)),
  capsule_capsule_overlap: (q) => meet(capsule(q.capsule1), capsule(q.capsule2)),
  capsule_box_overlap: (q) => meet(capsule(q.capsule), box(q.box)),
  capsule_triangle_overlap: (q) => meet(capsule(q.capsule), triangle(q.triangle)),
  triangle_box_overlap: (q) => meet(box(q.box), triangle(q.triangle)),
  box_box_overlap: { answer: (q) => meet(box(q.box1), box(q.box2)), gives: [] },
  sphere_sphere_penetration: { answer: (q) => overlap(sphere(q.sphere1), sphere(q.sphere2)), gives },
  sphere_box_penetration: { answer: (q) => overlap(sphere(q.sphere), box(q.box)), gives },
  box_box_penetration: { answer: (q) => overlap(box(q.box1), box(q.box2)), gives },
  point_sphere_signed_distance: { answer: (q) => pointDistance(q.point, sphere(q.sphere)), gives: distances },
  point_capsule_signed_distance: { answer: (q) => pointDistance(q.point, capsule(q.capsule)), gives: distances },
  sphere_sphere_signed_distance: { answer: (q) => distance(sphere(q.sphere1), sphere(q.sphere2)), gives: distances },
  sphere_capsule_signed_distance: { answer: (q) => distance(sphere(q.sphere), capsule(q.capsule)), gives: distances },
  capsule_capsule_signed_distance: { answer: (q) => distance(capsule(q.capsule1), capsule(q.capsule2)), gives: distances },
};
const released = Object.entries(queries).map(([query, offer]) =>
  [query, typeof offer === "function" ? releasing(offer) : { ...offer, answer: releasing(offer.answer) }]);
answerBy({ name: "havok", version: `@babylonjs/havok ${version}`, scalar: "float", queries: Object.fromEntries(released) });
