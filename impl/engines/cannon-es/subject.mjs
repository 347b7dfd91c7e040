// cannon-es: rays of Ray.intersectBody with mode CLOSEST, and contacts of Narrowphase.
import { Cannot } from "../../program/nearmiss.mjs";
import { answerBy, around, declared, dot, length, load, minus, plus, timeToPass, unit } from "../engine.mjs";

const { version, library: C } = await load("cannon-es");
const vec = (v) => new C.Vec3(...v);
const list = (v) => [v.x, v.y, v.z];

// Shapes, each as a body.
const body = (shape, at, turn = new C.Quaternion()) => {
  const b = new C.Body({ mass: 1, shape });
  b.position.copy(vec(at));
  b.quaternion.copy(turn);
  return b;
};
const sphere = ({ center, radius }) => body(new C.Sphere(radius), center);
const box = ({ center, half, orientation }) => body(new C.Box(vec(half)), center, new C.Quaternion(...orientation.map((x) => x / Math.hypot(...orientation))));
const point = (at) => body(new C.Particle(), at);
const triangle = ({ v0, v1, v2 }) => {
  const corners = [...v0, ...v1, ...v2];
  if (corners.some((x) => Math.fround(x) !== x)) throw new Cannot("Trimesh stores its vertices as floats");
  return body(new C.Trimesh(corners, [0, 1, 2]), [0, 0, 0]);
};
const plane = ({ normal, offset }) => {  // cannon's plane faces +z of its body
  const n = unit(normal), turn = new C.Quaternion();
  turn.setFromVectors(new C.Vec3(0, 0, 1), vec(n));
  return body(new C.Plane(), n.map((x) => x * -offset / length(normal)), turn);
};

// Calls.
const narrowphase = () => {
  const n = new C.World().narrowphase;
  return Object.assign(n, { result: [], frictionResult: [], contactPointPool: [], frictionEquationPool: [] });
};
function ray({ point, velocity }, target, horizon) {
  const r = new C.Ray(vec(point), vec(plus(point, velocity, horizon)));
  r.mode = C.Ray.CLOSEST;
  const result = new C.RaycastResult();
  r.intersectBody(target, result);
  return result.hasHit && { time: result.distance / length(velocity), location: list(result.hitPointWorld), normal: list(result.hitNormalWorld) };
}
function rayToBall(q, target, [center, radius]) {
  const horizon = timeToPass(q.point, q.velocity, center, radius);
  return horizon === 0 ? new Cannot("a ray has two ends") : ray(q, target, horizon);
}
function rayToPlane(q) {
  const n = unit(q.plane.normal), approach = Math.abs(dot(n, q.velocity));
  if (!(approach > 0)) return false;
  const foot = n.map((x) => x * -q.plane.offset / length(q.plane.normal));
  return ray(q, plane(q.plane), 2 ** Math.ceil(1 + Math.log2((Math.abs(dot(minus(q.point, foot), n)) || approach) / approach)));
}
/** All contacts of two bodies by the method of Narrowphase. */
function contacts(method, a, b) {
  const n = narrowphase();
  n.currentContactMaterial = n.world.defaultContactMaterial;
  n[method](a.shapes[0], b.shapes[0], a.position, b.position, a.quaternion, b.quaternion, a, b, a.shapes[0], b.shapes[0], false);
  return n.result.map((c) => {
    const contact = plus(list(a.position), list(c.ri)), other = plus(list(b.position), list(c.rj)), normal = list(c.ni);
    return { depth: dot(minus(contact, other), normal), normal, contact };
  });
}
function touches(method, a, b) {
  return narrowphase()[method](a.shapes[0], b.shapes[0], a.position, b.position, a.quaternion, b.quaternion, a, b, a.shapes[0], b.shapes[0], true) === true;
}
/** The deepest contact; its point where `more` has it. */
function depth(method, a, b, more) {
  const best = contacts(method, a, b).reduce((deepest, c) => (deepest && deepest.depth >= c.depth ? deepest : c), null);
  if (!best || !(best.depth >= 0)) return false;
  return { depth: best.depth, normal: best.normal, ...more?.(best) };
}

const backfaces = "cannon-es.d.ts: Ray has 'skipBackfaces: boolean', which its constructor sets to false";
const gives = ["depth", "normal"];
answerBy({
  name: "cannon-es", version: `cannon-es ${version}`, scalar: "double",
  queries: {
    moving_point_sphere: { answer: (q) => rayToBall(q, sphere(q.sphere), around.sphere(q.sphere)), declares: [declared("contact where it leaves", backfaces)] },
    moving_point_box: { answer: (q) => rayToBall(q, box(q.box), around.box(q.box)), declares: [declared("contact where it leaves", backfaces)] },
    moving_point_plane: { answer: rayToPlane, declares: [declared("two-sided", backfaces), declared("normal of the front", backfaces)] },
    sphere_sphere_overlap: (q) => touches("sphereSphere", sphere(q.sphere1), sphere(q.sphere2)),
    sphere_triangle_overlap: (q) => touches("sphereTrimesh", sphere(q.sphere), triangle(q.triangle)),
    point_sphere_overlap: (q) => touches("sphereParticle", sphere(q.sphere), point(q.point)),
    point_box_overlap: (q) => touches("boxParticle", box(q.box), point(q.point)),
    sphere_box_overlap: (q) => touches("sphereBox", sphere(q.sphere), box(q.box)),
    box_box_overlap: { answer: (q) => contacts("boxBox", box(q.box1), box(q.box2)).some((c) => c.depth >= 0), gives: [] },
    sphere_sphere_penetration: (q) => depth("sphereSphere", sphere(q.sphere1), sphere(q.sphere2), ({ contact }) => ({ contact })),
    sphere_box_penetration: { answer: (q) => depth("sphereBox", sphere(q.sphere), box(q.box)), gives },
    sphere_plane_penetration: (q) => depth("spherePlane", sphere(q.sphere), plane(q.plane), ({ normal, contact }) => ({ normal: normal.map((x) => -x), contact })),
    box_box_penetration: { answer: (q) => depth("boxBox", box(q.box1), box(q.box2)), gives },
  },
});
