// A collision library in JavaScript as a subject of Nearmiss, by nearmiss.mjs (docs/reference/protocol.md).
//
//     ./nearmiss run --command "node docs/example-program/balls.mjs" --subject balls-js
import { answer, Cannot } from "../../impl/program/nearmiss.mjs";

const minus = (a, b) => a.map((x, i) => x - b[i]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

function ballsMeet({ sphere1, sphere2 }) {
  return Math.hypot(...minus(sphere1.center, sphere2.center)) <= sphere1.radius + sphere2.radius;
}

function rayMeetsBall({ point, velocity, sphere: { center, radius } }) {
  const w = minus(point, center);
  const a = dot(velocity, velocity), b = dot(w, velocity), c = dot(w, w) - radius * radius;
  if (c < 0 || a === 0) return new Cannot("it starts inside, or does not move");
  if (b >= 0 || b * b < a * c) return false;
  const time = c / (Math.sqrt(b * b - a * c) - b);
  return { time, location: point.map((x, i) => x + velocity[i] * time) };
}

answer({
  name: "balls-js", version: "1.0", scalar: "double",
  queries: {
    sphere_sphere_overlap: ballsMeet,
    moving_point_sphere: { answer: rayMeetsBall, gives: ["time", "location"] },
  },
});
