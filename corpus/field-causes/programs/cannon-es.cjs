// cannon-es: rays of Ray.intersectBody with mode CLOSEST, and contacts of Narrowphase.
const { load, speak, dot, minus, plus, length, unit, timeToPass } = require("./speak.cjs");

load("cannon-es").then(({ version, library: C }) => {
  const vec = (v) => new C.Vec3(...v);
  const list = (v) => [v.x, v.y, v.z];
  const turned = (q) => { const [x, y, z, w] = unitOf(q); return new C.Quaternion(x, y, z, w); };
  const unitOf = (q) => { const n = Math.hypot(...q); return q.map((x) => x / n); };
  const body = (shape, at, q = new C.Quaternion()) => {
    const b = new C.Body({ mass: 1, shape });
    b.position.copy(vec(at));
    b.quaternion.copy(q);
    return b;
  };
  const ball = (at, r) => body(new C.Sphere(r), at);
  const box = (v) => body(new C.Box(vec(v.slice(3, 6))), v.slice(0, 3), turned(v.slice(6, 10)));
  const plane = (normal, offset) => {  // cannon's plane faces +z of its body
    const n = unit(normal), q = new C.Quaternion();
    q.setFromVectors(new C.Vec3(0, 0, 1), vec(n));
    return body(new C.Plane(), n.map((x) => x * -offset / length(normal)), q);
  };
  const narrow = () => {
    const world = new C.World();
    return world.narrowphase;
  };

  function ray(point, velocity, target, reach) {
    const horizon = timeToPass(point, velocity, ...reach);
    if (horizon === 0) return { cannot: "a ray has two ends" };
    const r = new C.Ray(vec(point), vec(plus(point, velocity, horizon)));
    r.mode = C.Ray.CLOSEST;
    const result = new C.RaycastResult();
    r.intersectBody(target, result);
    if (!result.hasHit) return { yes: false };
    return { yes: true, values: [result.distance / length(velocity), ...list(result.hitPointWorld), ...list(result.hitNormalWorld)] };
  }
  /** All contacts of two bodies by the method of Narrowphase. */
  function contacts(method, a, b) {
    const n = narrow();
    n.result = [], n.frictionResult = [], n.contactPointPool = [], n.frictionEquationPool = [];
    n.currentContactMaterial = n.world.defaultContactMaterial;
    n[method](a.shapes[0], b.shapes[0], a.position, b.position, a.quaternion, b.quaternion, a, b, a.shapes[0], b.shapes[0], false);
    return n.result.map((c) => {
      const onA = plus(list(a.position), list(c.ri)), onB = plus(list(b.position), list(c.rj)), normal = list(c.ni);
      return { depth: dot(minus(onA, onB), normal), normal, onA, onB };
    });
  }
  function touches(method, a, b) {
    const n = narrow();
    n.result = [], n.frictionResult = [];
    return { yes: n[method](a.shapes[0], b.shapes[0], a.position, b.position, a.quaternion, b.quaternion, a, b, a.shapes[0], b.shapes[0], true) === true };
  }
  const deepest = (all) => all.reduce((best, c) => (best && best.depth >= c.depth ? best : c), null);
  function depth(method, a, b, more) {
    const c = deepest(contacts(method, a, b));
    if (!c || !(c.depth >= 0)) return { yes: false, values: Array(more + 4).fill("none") };
    return { yes: true, values: [c.depth, ...c.normal, ...Array(more).fill(null)], contact: c };
  }

  const functions = {
    moving_point_sphere: (v) => ray(v.slice(0, 3), v.slice(3, 6), ball(v.slice(6, 9), v[9]), [v.slice(6, 9), v[9]]),
    moving_point_box: (v) => ray(v.slice(0, 3), v.slice(3, 6), box(v.slice(6)), [v.slice(6, 9), length(v.slice(9, 12))]),
    moving_point_plane: (v) => {
      const n = v.slice(6, 9), foot = unit(n).map((x) => x * -v[9] / length(n)), p = v.slice(0, 3), u = v.slice(3, 6);
      const approach = Math.abs(dot(unit(n), u));
      if (!(approach > 0)) return { yes: false };
      const time = 2 ** Math.ceil(1 + Math.log2((Math.abs(dot(minus(p, foot), unit(n))) || approach) / approach));
      const r = new C.Ray(vec(p), vec(plus(p, u, time)));
      r.mode = C.Ray.CLOSEST;
      const result = new C.RaycastResult();
      r.intersectBody(plane(n, v[9]), result);
      if (!result.hasHit) return { yes: false };
      return { yes: true, values: [result.distance / length(u), ...list(result.hitPointWorld), ...list(result.hitNormalWorld)] };
    },
    sphere_sphere_overlap: (v) => touches("sphereSphere", ball(v.slice(0, 3), v[3]), ball(v.slice(4, 7), v[7])),
    sphere_box_overlap: (v) => touches("sphereBox", ball(v.slice(0, 3), v[3]), box(v.slice(4))),
    sphere_sphere_penetration: (v) => {
      const { contact, ...said } = depth("sphereSphere", ball(v.slice(0, 3), v[3]), ball(v.slice(4, 7), v[7]), 3);
      if (contact) said.values.splice(4, 3, ...contact.onA);
      return said;
    },
    sphere_box_penetration: (v) => { const { contact, ...said } = depth("sphereBox", ball(v.slice(0, 3), v[3]), box(v.slice(4)), 3); return said; },
    sphere_plane_penetration: (v) => {
      const { contact, ...said } = depth("spherePlane", ball(v.slice(0, 3), v[3]), plane(v.slice(4, 7), v[7]), 3);
      if (contact) said.values = [contact.depth, ...contact.normal.map((x) => -x), ...contact.onA];
      return said;
    },
    box_box_overlap: (v) => ({ yes: contacts("boxBox", box(v.slice(0, 10)), box(v.slice(10, 20))).some((c) => c.depth >= 0), values: [null] }),
    box_box_penetration: (v) => {
      const c = deepest(contacts("boxBox", box(v.slice(0, 10)), box(v.slice(10, 20))));
      if (!c || !(c.depth >= 0)) return { yes: false, values: ["none", "none", "none", "none", "none", "none", "none", "none"] };
      return { yes: true, values: [c.depth, null, ...c.normal, null, null, null] };
    },
  };
  speak({ name: "cannon-es", version: `cannon-es ${version}`, scalar: "double" }, {
    sphere_box_penetration: ["depth", "normal"], box_box_overlap: [], box_box_penetration: ["depth", "normal"],
  }, functions);
});
