// Jolt: rays, collisions and casts of its shapes, by TransformedShape. The convex radius of boxes is zero.
const { load, speak, minus, plus, length, scaled, unit, timeToPass } = require("./speak.cjs");

load("jolt-physics", "dist/jolt-physics.wasm-compat.js").then(async ({ version, library }) => {
  const J = await library.default();
  const settings = new J.JoltSettings(), pairs = new J.ObjectLayerPairFilterTable(1), layers = new J.BroadPhaseLayerInterfaceTable(1, 1);
  layers.MapObjectToBroadPhaseLayer(0, new J.BroadPhaseLayer(0));
  settings.mObjectLayerPairFilter = pairs, settings.mBroadPhaseLayerInterface = layers;
  settings.mObjectVsBroadPhaseLayerFilter = new J.ObjectVsBroadPhaseLayerFilterTable(layers, 1, pairs, 1);
  new J.JoltInterface(settings);  // registers the shapes
  const still = [0, 0, 0, 1], list = (v) => [v.GetX(), v.GetY(), v.GetZ()];
  const kept = [];
  const keep = (object) => (kept.push(object), object);
  const free = () => { while (kept.length) J.destroy(kept.pop()); };
  const vec = (v) => keep(new J.Vec3(...v.slice(0, 3))), rvec = (v) => keep(new J.RVec3(...v.slice(0, 3)));
  const quat = (q) => keep(new J.Quat(...q));
  const ball = (v) => ({ shape: new J.SphereShape(v[3]), at: v.slice(0, 3), turn: still });
  const box = (v) => ({ shape: new J.BoxShape(vec(v.slice(3, 6)), 0), at: v.slice(0, 3), turn: scaled(v.slice(6, 10), 1 / Math.hypot(...v.slice(6, 10))) });
  /** Jolt's capsules are along y. */
  const capsule = (v) => {
    const p0 = v.slice(0, 3), p1 = v.slice(3, 6), l = length(minus(p1, p0));
    if (!(l > 0)) return ball([...p0, v[6]]);
    const [x, y, z] = unit(minus(p1, p0)), q = y > -1 ? [z, 0, -x, 1 + y] : [1, 0, 0, 0];
    return { shape: new J.CapsuleShape(l / 2, v[6]), at: scaled(plus(p0, p1), 0.5), turn: scaled(q, 1 / Math.hypot(...q)) };
  };
  const plane = (n, offset) => ({ shape: new J.PlaneShape(keep(new J.Plane(vec(unit(n)), offset / length(n)))), at: [0, 0, 0], turn: still });
  const placed = (b) => {
    b.shape.AddRef();
    const remainder = keep(new J.SubShapeID());
    return b.shape.GetSubShapeTransformedShape(keep(new J.SubShapeID()), vec(b.at), quat(b.turn), vec([1, 1, 1]), remainder);
  };
  const anyShape = new J.ShapeFilter(), zero = new J.RVec3(0, 0, 0);

  function ray(v, make, center, radius) {
    const horizon = timeToPass(v.slice(0, 3), v.slice(3, 6), center, radius);
    if (horizon === 0) return { cannot: "a ray has two ends" };
    const b = make(), hit = keep(new J.RayCastResult());
    hit.mFraction = 1 + 1e-6;
    placed(b).CastRay(keep(new J.RRayCast(rvec(v), vec(scaled(v.slice(3, 6), horizon)))), hit);
    const fraction = hit.mFraction;
    b.shape.Release(), free();
    return fraction <= 1 ? { yes: true, values: [fraction * horizon, ...Array(6).fill(null)] } : { yes: false };
  }
  function collision(a, b) {
    const settings = keep(new J.CollideShapeSettings()), collector = keep(new J.CollideShapeClosestHitCollisionCollector());
    a.shape.AddRef();
    const pose = J.RMat44.prototype.sRotationTranslation(quat(a.turn), rvec(a.at));
    placed(b).CollideShape(a.shape, vec([1, 1, 1]), pose, settings, zero, collector, anyShape);
    const hit = collector.HadHit() ? [collector.mHit.mPenetrationDepth, ...unit(list(collector.mHit.mPenetrationAxis))] : null;
    a.shape.Release(), b.shape.Release(), free();
    return hit;
  }
  const meet = (a, b) => ({ yes: collision(a, b) !== null });
  const depth = (hit, sign = 1) => hit ? { yes: true, values: [hit[0], ...hit.slice(1).map((x) => sign * x), null, null, null] } : { yes: false, values: Array(7).fill("none") };
  const boxDepth = (hit) => hit ? { yes: true, values: [hit[0], null, ...hit.slice(1), null, null, null] } : { yes: false, values: Array(8).fill("none") };

  const functions = {
    moving_point_sphere: (v) => ray(v, () => ball(v.slice(6, 10)), v.slice(6, 9), v[9]),
    moving_point_box: (v) => ray(v, () => box(v.slice(6)), v.slice(6, 9), length(v.slice(9, 12))),
    moving_point_capsule: (v) => ray(v, () => capsule(v.slice(6)), scaled(plus(v.slice(6, 9), v.slice(9, 12)), 0.5), length(minus(v.slice(9, 12), v.slice(6, 9))) / 2 + v[12]),
    sphere_sphere_overlap: (v) => meet(ball(v), ball(v.slice(4))),
    sphere_box_overlap: (v) => meet(ball(v), box(v.slice(4))),
    box_box_overlap: (v) => ({ ...meet(box(v), box(v.slice(10))), values: [null] }),
    sphere_sphere_penetration: (v) => depth(collision(ball(v), ball(v.slice(4)))),
    sphere_box_penetration: (v) => depth(collision(ball(v), box(v.slice(4)))),
    sphere_plane_penetration: (v) => depth(collision(ball(v), plane(v.slice(4, 7), v[7])), -1),
    box_box_penetration: (v) => boxDepth(collision(box(v), box(v.slice(10)))),
  };
  const depths = ["depth", "normal"], rays = ["time"];
  speak({ name: "jolt", version: `jolt-physics ${version}`, scalar: "float" }, {
    moving_point_sphere: rays, moving_point_box: rays, moving_point_capsule: rays, box_box_overlap: [],
    sphere_sphere_penetration: depths, sphere_box_penetration: depths, sphere_plane_penetration: depths, box_box_penetration: depths,
  }, functions);
});
