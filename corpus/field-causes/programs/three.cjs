// three: Ray, Box3, OBB, Line3 and Triangle of its math, and Octree of its examples.
const { load, speak, length, scaled, unit } = require("./speak.cjs");

const name = process.argv[3] || "three";  // of the package, and of the subject

Promise.all([load(name, "build/three.module.js"), load(name, "examples/jsm/math/OBB.js"), load(name, "examples/jsm/math/Octree.js"),
  load(name, "examples/jsm/math/Capsule.js")])
  .then(([{ version, library: T }, { library: { OBB } }, { library: { Octree } }, { library: { Capsule } }]) => {
    const vec = (v) => new T.Vector3(...v);
    const list = (v) => [v.x, v.y, v.z];
    const sphere = (v) => new T.Sphere(vec(v), v[3]);
    const box3 = (v) => new T.Box3(vec(v.slice(0, 3)), vec(v.slice(3, 6)));
    const triangle = (v) => new T.Triangle(vec(v.slice(0, 3)), vec(v.slice(3, 6)), vec(v.slice(6, 9)));
    const obb = (v) => {
      const [x, y, z, w] = scaled(v.slice(6, 10), 1 / Math.hypot(...v.slice(6, 10)));
      const turn = new T.Matrix3().setFromMatrix4(new T.Matrix4().makeRotationFromQuaternion(new T.Quaternion(x, y, z, w)));
      return new OBB(vec(v.slice(0, 3)), vec(v.slice(3, 6)), turn);
    };
    /** three's rays have a direction of length 1 and give the place, or null. */
    function ray(v, ask) {
      const speed = length(v.slice(3, 6));
      if (!(speed > 0)) return null;
      const r = new T.Ray(vec(v), vec(unit(v.slice(3, 6)))), place = new T.Vector3();
      if (ask(r, place) === null) return undefined;
      return { time: place.distanceTo(r.origin) / speed, place: list(place) };
    }
    const impact = (hit) => hit === null ? { cannot: "a ray has a direction" } : !hit ? { yes: false } :
      { yes: true, values: [hit.time, ...hit.place, null, null, null] };
    const functions = {
      moving_point_sphere: (v) => impact(ray(v, (r, p) => r.intersectSphere(sphere(v.slice(6)), p))),
      moving_point_plane: (v) => impact(ray(v, (r, p) => r.intersectPlane(new T.Plane(vec(v.slice(6, 9)), v[9]).normalize(), p))),
      moving_point_triangle: (v) => impact(ray(v, (r, p) => { const t = triangle(v.slice(6)); return r.intersectTriangle(t.a, t.b, t.c, true, p); })),
      moving_point_box: (v) => impact(ray(v, (r, p) => obb(v.slice(6)).intersectRay(r, p))),
      moving_point_aabox: (v) => {
        const hit = ray(v, (r, p) => r.intersectBox(box3(v.slice(6)), p));
        if (hit === null) return { cannot: "a ray has a direction" };
        return hit ? { yes: true, values: [null, ...hit.place, hit.time, null, null, null] } : { yes: false };
      },
      ray_aabox: (v) => {
        const hit = ray(v, (r, p) => r.intersectBox(box3(v.slice(6)), p));
        return hit ? { yes: true, values: [null, ...hit.place] } : { yes: false };
      },
      sphere_sphere_overlap: (v) => ({ yes: sphere(v).intersectsSphere(sphere(v.slice(4))) }),
      sphere_box_overlap: (v) => ({ yes: obb(v.slice(4)).intersectsSphere(sphere(v)) }),
      box_box_overlap: (v) => ({ yes: obb(v).intersectsOBB(obb(v.slice(10))), values: [null] }),
      sphere_triangle_overlap: (v) => ({ yes: !!new Octree().triangleSphereIntersect(sphere(v), triangle(v.slice(4))) }),
      aabox_triangle_overlap: (v) => ({ yes: box3(v).intersectsTriangle(triangle(v.slice(6))) }),
      moving_sphere_passes_box: (v) => {  // of an axis-aligned box, with the sphere's way as a capsule
        if (v[13] || v[14] || v[15] || v[18]) return { cannot: "a turned box, or a way without end" };
        const way = new Capsule(vec(v), vec([v[0] + v[4] * v[17], v[1] + v[5] * v[17], v[2] + v[6] * v[17]]), v[3]);
        const low = [v[7] - v[10], v[8] - v[11], v[9] - v[12]], high = [v[7] + v[10], v[8] + v[11], v[9] + v[12]];
        return { yes: way.intersectsBox(box3([...low, ...high])) };
      },
      closest_point_segment: (v) => ({ values: list(new T.Line3(vec(v), vec(v.slice(3, 6))).closestPointToPoint(vec(v.slice(6)), true, new T.Vector3())) }),
      point_in_triangle: (v) => {
        const t = triangle(v), p = vec(v.slice(13, 16)), weights = t.getBarycoord(p, new T.Vector3());
        return t.containsPoint(p) ? { yes: true, values: list(weights) } : { yes: false };
      },
    };
    const impacts = ["time", "location"];
    speak({ name, version: `three ${version}`, scalar: "double" }, {
      moving_point_sphere: impacts, moving_point_plane: impacts, moving_point_triangle: impacts, moving_point_box: impacts,
      moving_point_aabox: impacts, ray_aabox: ["location"], box_box_overlap: [],
    }, functions);
  });
