"use strict";
/// Turns the shapes of a picture into lines and triangles for one zoom. Coordinates of a picture are relative to the contact
/// (reports/page/picture.hpp). `by` moves a shape, `zoom` is view units for each unit of the picture; what lies further
/// than `far` view units from the contact is cut off, so every coordinate of the result is small and a picture is as
/// steady at the scale of an ulp as at that of the whole.
nearmiss.shapes = (() => {
  const far = 14;          // view units
  const roundAbove = 150;  // view units: a larger radius is drawn as a patch about the contact
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const add = (a, b, k = 1) => [a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]];
  const times = (a, k) => [a[0] * k, a[1] * k, a[2] * k];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const length = a => Math.hypot(a[0], a[1], a[2]);
  const unit = a => { const l = length(a); return l > 0 ? times(a, 1 / l) : a; };
  const zero = [0, 0, 0];

  /// Two unit vectors that are perpendicular to n and to each other.
  function tangents(n) {
    const least = n.map(Math.abs).indexOf(Math.min(...n.map(Math.abs)));
    const t = unit(cross(n, [0, 1, 2].map(i => (i === least ? 1 : 0))));
    return [t, cross(n, t)];
  }

  class Drawing {
    constructor() { this.lines = []; this.triangles = []; this.points = []; }
    line(a, b) { this.lines.push(...a, ...b); }
    triangle(a, b, c) { this.triangles.push(...a, ...b, ...c); }
    point(p) { if (p.every(Number.isFinite) && length(p) < far * 4) this.points.push(...p); }
    grid(rows, columns, at, keep = () => true) {
      for (let i = 0; i < rows; ++i) {
        for (let k = 0; k < columns; ++k) {
          const c = [at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)];
          if (!c.every(p => p.every(Number.isFinite)) || !keep(c)) continue;
          this.triangle(c[0], c[1], c[2]);
          this.triangle(c[0], c[2], c[3]);
          if (k % 4 === 0) this.line(c[0], c[1]);
          if (i % 4 === 0) this.line(c[0], c[3]);
        }
      }
    }
  }

  /// Lines in a plane, which show its slope where none of its edges is in sight.
  function mesh(drawing, foot, t, s, size, steps) {
    for (let i = 0; i <= steps; ++i) {
      const u = size * (2 * i / steps - 1);
      drawing.line(add(add(foot, t, u), s, -size), add(add(foot, t, u), s, size));
      drawing.line(add(add(foot, s, u), t, -size), add(add(foot, s, u), t, size));
    }
  }

  /// The part of the plane n . x = d within half-spaces m . x <= e. An edge on a half-space's border becomes a line.
  function flat(drawing, n, d, halfSpaces, size = far) {
    if (!(Math.abs(d) < size * 1.5)) return;
    const [t, s] = tangents(n), foot = times(n, d);
    let polygon = [[1, 1], [-1, 1], [-1, -1], [1, -1]]
      .map(([u, v]) => ({at: add(add(foot, t, u * size), s, v * size), border: false}));
    for (const {n: m, d: e} of halfSpaces) {
      const next = [];
      polygon.forEach((p, i) => {
        const q = polygon[(i + 1) % polygon.length], a = dot(m, p.at) - e, b = dot(m, q.at) - e;
        const crossing = () => add(p.at, add(q.at, p.at, -1), a / (a - b));
        if (a <= 0) next.push(p);
        if (a <= 0 && b > 0) next.push({at: crossing(), border: true});
        if (a > 0 && b <= 0) next.push({at: crossing(), border: p.border});
      });
      polygon = next;
      if (polygon.length < 3) return;
    }
    for (let i = 2; i < polygon.length; ++i) drawing.triangle(polygon[0].at, polygon[i - 1].at, polygon[i].at);
    polygon.forEach((p, i) => { if (p.border) drawing.line(p.at, polygon[(i + 1) % polygon.length].at); });
    if (!polygon.some(p => p.border)) mesh(drawing, foot, t, s, size, 10);
  }

  function moved(face, by) { return {n: face.n, d: face.d + dot(face.n, by)}; }
  const scaled = (face, zoom) => ({n: face.n, d: face.d * zoom});

  /// A carrier after a move: its point nearest to the contact, and its ends.
  function movedCarrier(c, by) {
    const along = dot(c.along, by), across = add(by, c.along, -along);
    const end = x => (x === null ? null : x + along);
    const foot = add(c.foot, across), sum = length(foot) + length(c.foot);
    const distance = c.distance === undefined || sum === 0 ? c.distance
      : c.distance + (2 * dot(c.foot, across) + dot(across, across)) / sum;
    return {foot, along: c.along, from: end(c.from), to: end(c.to), distance};
  }
  /// The ends in view units, cut off at `most`.
  function ends(c, zoom, most) {
    return [c.from === null ? -most : Math.max(-most, c.from * zoom), c.to === null ? most : Math.min(most, c.to * zoom)];
  }

  function carrier(drawing, c, zoom) {
    const foot = times(c.foot, zoom);
    if (!(length(foot) < far * 2)) return;
    if (dot(c.along, c.along) === 0) return drawing.point(foot);
    const [a, b] = ends(c, zoom, far * 1.5);
    if (a <= b) drawing.line(add(foot, c.along, a), add(foot, c.along, b));
  }

  /// The height of a ball of radius r over its tangent plane, at the distance `across` from where it touches the plane.
  const sagitta = (r, square) => (square > r * r ? NaN : square / (r + Math.sqrt(r * r - square)));

  function ball(drawing, center, radius, distance, by, zoom, keep) {
    const c = add(center, by), sum = length(c) + length(center);
    const gap = sum === 0 ? distance : distance + (2 * dot(center, by) + dot(by, by)) / sum;
    const r = radius * zoom;
    if (!(gap * zoom < far * 2)) return;
    if (r <= roundAbove) return wholeBall(drawing, times(c, zoom), r, keep);
    if (!(Math.abs(gap) * zoom < far * 2)) return;
    const n = unit(c), [t, s] = tangents(n), steps = 32;
    const at = (i, k) => {
      const u = far * (2 * i / steps - 1), v = far * (2 * k / steps - 1);
      return add(add(times(n, gap * zoom + sagitta(r, u * u + v * v)), t, u), s, v);
    };
    drawing.grid(steps, steps, at, keep);
  }
  function wholeBall(drawing, c, r, keep) {
    if (r < 1e-3) return drawing.point(c);
    const columns = r < 0.1 ? 16 : r < 0.4 ? 24 : 48, rows = columns / 2;
    drawing.grid(rows, columns, (i, k) => {
      const a = Math.PI * i / rows, b = 2 * Math.PI * k / columns;
      return add(c, [Math.sin(a) * Math.cos(b), Math.sin(a) * Math.sin(b), Math.cos(a)], r);
    }, keep);
  }

  /// The tube of a capsule, between its ends.
  function tube(drawing, axis, radius, zoom) {
    const r = radius * zoom, [a, b] = ends(axis, zoom, far * 1.5);
    if (!(a <= b) || dot(axis.along, axis.along) === 0) return;
    if (r <= roundAbove) {
      const [t, s] = tangents(axis.along), foot = times(axis.foot, zoom), columns = 48, rows = 8;
      if (!(length(foot) - r < far * 2)) return;
      return drawing.grid(rows, columns, (i, k) => {
        const angle = 2 * Math.PI * k / columns;
        const around = add(times(t, Math.cos(angle)), s, Math.sin(angle));
        return add(add(foot, axis.along, a + (b - a) * i / rows), around, r);
      });
    }
    if (!(Math.abs(axis.distance) * zoom < far * 2)) return;
    const n = unit(axis.foot), across = cross(axis.along, n), steps = 32;
    drawing.grid(steps, steps, (i, k) => {
      const u = a + (b - a) * i / steps, v = far * (2 * k / steps - 1);
      return add(add(times(n, axis.distance * zoom + sagitta(r, v * v)), axis.along, u), across, v);
    });
  }
  function capsule(drawing, shape, by, zoom) {
    const axis = movedCarrier(shape.axis, by);
    const isBall = dot(axis.along, axis.along) === 0;
    tube(drawing, axis, shape.radius, zoom);
    shape.corners.forEach((c, i) => {
      if (isBall && i > 0) return;
      const sign = i === 0 ? -1 : 1, end = (i === 0 ? axis.from : axis.to) * zoom;
      const beyond = isBall ? undefined : quad => quad.some(p => sign * (dot(p, axis.along) - end) >= -1e-9);
      ball(drawing, c, shape.radius, shape.distances[i], by, zoom, beyond);
    });
    if (shape.radius === 0) carrier(drawing, axis, zoom);
  }

  function box(drawing, shape, by, zoom) {
    const faces = shape.faces.map(f => scaled(moved(f, by), zoom));
    const isOpposite = (i, k) => (i ^ 1) === k;
    faces.forEach((f, i) => flat(drawing, f.n, f.d, faces.filter((_, k) => k !== i && !isOpposite(i, k)), far * 1.2));
    const size = Math.max(...[0, 2, 4].map(i => faces[i].d + faces[i + 1].d));
    if (size < 1e-3) drawing.point(times(add(shape.corners[0], by), zoom));
  }

  function polygon(drawing, shape, by, zoom) {
    for (const piece of shape.pieces)
      flat(drawing, piece.n, (piece.d + dot(piece.n, by)) * zoom, piece.edges.map(e => scaled(moved(e, by), zoom)), far * 1.2);
    for (const side of shape.sides) carrier(drawing, movedCarrier(side, by), zoom);
  }

  /// The lines, triangles and points of a shape that is moved by `by`.
  function draw(shape, by, zoom) {
    const d = new Drawing();
    if (shape.plane) {
      const face = scaled(moved(shape.plane, by), zoom), extent = 2.4;  // of a plane a piece is drawn
      flat(d, face.n, face.d, [], extent);
    } else if (shape.faces) {
      box(d, shape, by, zoom);
    } else if (shape.pieces) {
      polygon(d, shape, by, zoom);
    } else if (shape.axis) {
      capsule(d, shape, by, zoom);
    } else if (shape.distances) {
      ball(d, shape.corners[0], shape.radius, shape.distances[0], by, zoom);
    } else if (shape.sides) {
      for (const side of shape.sides) carrier(d, movedCarrier(side, by), zoom);
      if (shape.kind === "ray") d.point(times(add(shape.corners[0], by), zoom));
    } else if (shape.kind === "point") {
      d.point(times(add(shape.corners[0], by), zoom));
    }
    return d;
  }

  return {draw, carrier, Drawing, dot, add, times, cross, length, unit, tangents, zero, far};
})();
