"use strict";
/// The picture of a case: turn, pan, zoom from the whole to the last bit, and move along the way.
nearmiss.picture = (() => {
  const {element, about, exact} = nearmiss.numbers;
  const {draw, Drawing, carrier, add, times, cross, dot, length, unit, tangents, zero} = nearmiss.shapes;
  const colour = name => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

  let renderer = null, failed = false;
  function rendererOrNull() {
    if (renderer || failed) return renderer;
    try {
      renderer = new THREE.WebGLRenderer({antialias: true, alpha: true, preserveDrawingBuffer: true});
    } catch (e) {
      failed = true;
    }
    return renderer;
  }

  const glyphs = new Map();
  /// A sign for points that keeps its size: "dot", "ring" or "cross".
  function glyph(kind) {
    if (glyphs.has(kind)) return glyphs.get(kind);
    const canvas = element("canvas", {width: 64, height: 64}), c = canvas.getContext("2d");
    c.strokeStyle = c.fillStyle = "#fff";
    c.lineWidth = 11;
    c.beginPath();
    if (kind === "cross") { c.moveTo(12, 12); c.lineTo(52, 52); c.moveTo(52, 12); c.lineTo(12, 52); c.stroke(); }
    else { c.arc(32, 32, kind === "ring" ? 23 : 26, 0, 7); kind === "ring" ? c.stroke() : c.fill(); }
    glyphs.set(kind, new THREE.CanvasTexture(canvas));
    return glyphs.get(kind);
  }

  class Picture {
    constructor(host, data, texts) {
      Object.assign(this, {host, data, texts, at: 0});
      this.canvas = rendererOrNull().domElement;
      this.canvas.setAttribute("role", "img");
      this.canvas.setAttribute("aria-label", texts.label);
      this.world = new THREE.Scene();
      this.camera = new THREE.PerspectiveCamera(26, 1, 0.1, 200);
      this.limits();
      this.build();
      this.look();
      this.resize();
      this.observer = new ResizeObserver(() => this.resize());
      this.observer.observe(this.frame);
      this.set(this.levels.whole);
    }
    end() {
      this.observer.disconnect();
      this.controls.dispose();
      this.clear();
    }

    // --- zoom: the logarithm to base 2 of view units for each unit of the picture ---
    limits() {
      const s = this.data, log = x => Math.log2(x);
      const start = s.motion ? Math.abs(s.motion.start) : 0;
      this.fit = log(1.45 / Math.max(s.reach, 0.7 * Math.min(start, 4 * s.reach), 1e-300));  // with the start where it is near
      this.least = Math.min(this.fit, log(0.9 / Math.max(start, s.reach, 1e-300))) - 1;
      this.most = Math.max(log(0.35 / s.ulp), this.fit) + 2;
      const apart = this.disagreement();
      this.levels = {whole: this.fit, ulp: log(0.35 / s.ulp),
                     disagreement: apart > 0 ? Math.min(this.most, Math.max(this.least, log(0.7 / apart))) : null};
    }
    /// How far the claimed contact is from the true one; without both, how far the inputs may move.
    disagreement() {
      const {contacts, motion} = this.data, truth = contacts.find(c => c.of === "true"), claim = contacts.find(c => c.of === "claimed");
      const apart = truth && claim ? length(add(truth.at, claim.at, -1)) : 0;
      const late = motion && motion.true && motion.claimed !== null ? Math.abs(motion.claimed - motion.true[0]) : 0;
      return Math.max(apart, late) || this.texts.moved || 0;
    }
    set(level) {
      this.level = Math.min(this.most, Math.max(this.least, level));
      this.zoom = 2 ** this.level;
      this.zoomer.value = String(1000 * (this.level - this.least) / (this.most - this.least));
      this.retime();
      this.draw();
    }

    // --- time: distance along the way from the true contact ---
    retime() {
      const m = this.data.motion;
      if (!m) return;
      const window = 3 / this.zoom, end = Math.max(0, m.claimed ?? 0, m.true ? m.true[1] : 0);
      const spare = Math.max(0.15 * (end - m.start), m.true || m.claimed !== null ? 0 : this.data.reach);
      this.from = Math.max(m.start, -window);
      this.to = Math.max(this.from, Math.min(m.limit ?? Infinity, end + spare, window));
      this.at = Math.min(this.to, Math.max(this.from, this.at));
      this.timer.value = String(this.to > this.from ? 1000 * (this.at - this.from) / (this.to - this.from) : 0);
    }
    tellTime() {
      const m = this.data.motion;
      if (!m) return;
      const change = this.at * m.time_per_unit, near = Math.abs(change) < 1e-6 * Math.abs(m.time);
      const base = m.true ? "true time" : m.claimed !== null ? "claimed time" : "nearest approach";
      this.time.textContent = this.at === 0 ? `${base} ${exact(m.time, this.data.scalar)}`
        : near ? `${base} ${change < 0 ? "−" : "+"} ${about(Math.abs(change))}` : `time ${about(m.time + change)}`;
    }

    // --- elements ---
    build() {
      const button = (name, key, text) => this.levels[name] === null ? null :
        element("button", {type: "button", class: "level", "data-level": name, title: `${text} (${key})`, onclick: () => this.goTo(name)}, text);
      this.zoomer = element("input", {type: "range", min: 0, max: 1000, step: "any", "aria-label": "Zoom",
        oninput: () => this.set(this.least + this.zoomer.value / 1000 * (this.most - this.least))});
      this.timer = element("input", {type: "range", min: 0, max: 1000, step: "any", "aria-label": "Time along the motion",
        oninput: () => { this.at = this.from + this.timer.value / 1000 * (this.to - this.from); this.draw(); }});
      this.time = element("output", {class: "time"});
      this.bar = element("div", {class: "bar"}, element("i"), this.barText = element("span"));
      this.frame = element("div", {class: "frame"}, this.canvas, this.bar);
      const zoom = element("div", {class: "control"}, element("span", {class: "what"}, "Zoom"), this.zoomer,
        button("whole", "1", "whole"), button("disagreement", "2", "disagreement"), button("ulp", "3", "ulp"));
      const time = this.data.motion ? element("div", {class: "control"}, element("span", {class: "what"}, "Time"), this.timer,
        element("button", {type: "button", onclick: () => { this.at = 0; this.retime(); this.draw(); }}, "contact"), this.time) : null;
      this.host.replaceChildren(this.frame, zoom, ...(time ? [time] : []), this.legend());
      this.canvas.onwheel = e => { e.preventDefault(); this.set(this.level - e.deltaY / 240); };
    }
    goTo(name) {
      if (this.levels[name] === null) return;
      this.controls.target.set(0, 0, 0);
      this.set(this.levels[name]);
    }
    legend() {
      const s = this.data, entries = [];
      const entry = (c, text, sign = "area") => entries.push(element("span", {}, element("i", {class: sign, style: `--own: var(--${c})`}), text));
      s.shapes.filter(x => x.kind !== "direction").forEach(x => entry(this.colourOf(x), `${x.name}${x.moves ? ", moves" : ""}`, x.kind === "point" ? "dot" : "area"));
      s.shapes.filter(x => x.kind === "direction").forEach(x => entry("fixed", x.name, "stroke"));
      if (s.contacts.some(c => c.of === "true")) entry("truth", "exact", "ring");
      if (s.contacts.some(c => c.of === "also true")) entry("truth", "other right answers", "ring small");
      if (s.contacts.some(c => c.of === "claimed")) entry("claim", `says ${this.texts.subject}`, "cross");
      this.spacing = element("span", {class: "spacing", hidden: true}, element("i", {class: "mesh"}), "lines one ulp of the largest coordinate apart");
      return element("p", {class: "legend"}, entries, this.spacing);
    }
    resize() {
      const width = this.frame.clientWidth || 640, height = this.frame.clientHeight || 360;
      rendererOrNull().setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
      rendererOrNull().setSize(width, height, false);
      this.camera.aspect = width / height;
      this.camera.updateProjectionMatrix();
      this.size = [width, height];
      if (this.zoom) this.draw();
    }
    /// Looks across the motion and the normal, so that the contact is seen in profile.
    look() {
      const s = this.data, normal = (s.contacts.find(c => c.normal) || {}).normal;
      const along = s.motion ? s.motion.along : null;
      let up = normal && length(normal) > 0 ? normal : [0, 0, 1], side = along ? cross(along, up) : zero;
      if (length(side) < 0.05) side = tangents(up)[0];
      side = unit(side);
      const from = unit(add(add(side, up, 0.42), cross(up, side), 0.3));
      this.camera.up.set(...up);
      this.camera.position.set(...times(from, 6.2));
      this.controls = new THREE.OrbitControls(this.camera, this.canvas);
      this.controls.enableZoom = false;
      this.controls.enableKeys = false;
      this.controls.addEventListener("change", () => this.render());
      this.controls.addEventListener("end", () => this.draw());
      this.controls.update();
    }

    // --- drawing ---
    clear() {
      for (const child of [...this.world.children]) {
        this.world.remove(child);
        if (child.geometry) child.geometry.dispose();
        if (child.material) child.material.dispose();
      }
    }
    draw() {
      this.clear();
      const s = this.data, m = s.motion, along = m ? m.along : zero;
      for (const shape of s.shapes) {
        if (shape.kind === "direction") continue;
        if (!shape.moves) { this.add(draw(shape, zero, this.zoom), this.colourOf(shape), {}); continue; }
        this.add(draw(shape, times(along, this.at), this.zoom), "moving", {});
        if (m.true && this.at !== 0) this.add(draw(shape, zero, this.zoom), "truth", {ghost: true});
        if (m.claimed !== null) this.add(draw(shape, times(along, m.claimed), this.zoom), "claim", {ghost: true});
        this.way(shape);
      }
      this.directions();
      s.contacts.forEach((c, i) => this.contact(c, i));
      this.lattice();
      this.tellTime();
      this.tellScale();
      this.render();
    }
    /// Where nothing moves, the first shape has the colour of what moves, to tell the two apart.
    colourOf(shape) { return shape.moves || (!this.data.motion && shape === this.data.shapes[0]) ? "moving" : "fixed"; }
    way(shape) {
      const m = this.data.motion, p = shape.corners ? shape.corners[0] : zero, at = dot(p, m.along), d = new Drawing();
      const end = Math.max(0, m.claimed ?? 0, this.at) + 0.5 / this.zoom;
      carrier(d, {foot: add(p, m.along, -at), along: m.along, from: at + m.start, to: at + end}, this.zoom);
      this.add(d, "moving", {thin: true});
    }
    /// Input directions begin at the last point before them, otherwise at the contact.
    directions() {
      let foot = zero;
      for (const s of this.data.shapes) {
        if (s.kind === "point") foot = s.corners[0];
        if (s.kind === "direction") this.arrow(times(foot, this.zoom), s.direction, "fixed", 0.6);
      }
    }
    arrow(from, direction, name, size) {
      if (!(length(from) < 20) || !(length(direction) > 0)) return;
      const d = new Drawing(), to = add(from, direction, size), [t, s] = tangents(unit(direction));
      d.line(from, to);
      for (const side of [t, s, times(t, -1), times(s, -1)]) d.line(to, add(add(to, direction, -0.14), side, 0.06));
      this.add(d, name, {front: true});
    }
    contact(c) {
      const at = times(c.at, this.zoom), d = new Drawing(), name = c.of === "claimed" ? "claim" : "truth";
      if (!at.every(Number.isFinite)) return;
      if (c.half) {
        d.point(at);
        const h = times(c.half, this.zoom);
        if (Math.max(...h) > 0.02) this.enclosure(d, at, h);
      }
      if (c.of === "also true") return this.add(d, name, {glyph: "ring", size: 9, opacity: 0.6});
      this.add(d, name, {glyph: c.of === "true" ? "ring" : "cross", size: c.of === "true" ? 17 : 13, front: true});
      if (c.normal) this.arrow(at, c.normal, name, c.of === "true" ? 0.62 : 0.5);
    }
    /// The true contact lies somewhere in this box.
    enclosure(d, at, h) {
      const corner = i => add(at, [i & 1 ? h[0] : -h[0], i & 2 ? h[1] : -h[1], i & 4 ? h[2] : -h[2]]);
      for (let i = 0; i < 8; ++i) for (const bit of [1, 2, 4]) if (!(i & bit)) d.line(corner(i), corner(i | bit));
    }
    /// Numbers of the scalar next to each other, in the plane of two coordinates that is seen best.
    lattice() {
      const step = this.data.ulp * this.zoom, visible = step > 0.11 && step < 3;
      this.spacing.hidden = !visible;
      if (!visible) return;
      const view = this.camera.position.clone().sub(this.controls.target).toArray().map(Math.abs);
      const flat = view.indexOf(Math.max(...view)), n = Math.min(12, Math.max(2, Math.round(1.6 / step))), d = new Drawing();
      const point = (u, v) => [0, 1, 2].map(i => (i === flat ? 0 : i === (flat + 1) % 3 ? u : v) * step);
      for (let u = -n; u <= n; ++u) {
        d.line(point(u, -n), point(u, n));
        d.line(point(-n, u), point(n, u));
      }
      this.add(d, "soft", {thin: true});
    }
    add(drawing, name, {ghost = false, thin = false, front = false, glyph: sign = "dot", size = 9, opacity = 1}) {
      const c = new THREE.Color(colour(name));
      if (drawing.triangles.length && !ghost) {
        const g = new THREE.BufferGeometry();
        g.setAttribute("position", new THREE.Float32BufferAttribute(drawing.triangles, 3));
        const m = new THREE.MeshBasicMaterial({color: c, transparent: true, opacity: name === "moving" ? 0.2 : 0.16, side: THREE.DoubleSide, depthWrite: false});
        this.world.add(new THREE.Mesh(g, m));
      }
      if (drawing.lines.length) {
        const g = new THREE.LineSegmentsGeometry().setPositions(drawing.lines);
        const m = new THREE.LineMaterial({color: c.getHex(), linewidth: front ? 2.6 : thin ? 1 : ghost ? 1.1 : 1.5, transparent: true,
                                          opacity: thin ? 0.6 : ghost ? 0.75 : drawing.lines.length > 900 ? 0.55 : 0.95, depthTest: !front});
        m.resolution.set(...this.size);
        const lines = new THREE.LineSegments2(g, m);
        lines.renderOrder = front ? 3 : 1;
        lines.frustumCulled = false;
        this.world.add(lines);
      }
      if (drawing.points.length) {
        const g = new THREE.BufferGeometry();
        g.setAttribute("position", new THREE.Float32BufferAttribute(drawing.points, 3));
        const m = new THREE.PointsMaterial({color: c, size: size * Math.min(2, window.devicePixelRatio || 1), sizeAttenuation: false, map: glyph(sign), transparent: true, opacity, depthTest: false, alphaTest: 0.15});
        const points = new THREE.Points(g, m);
        points.renderOrder = 4;
        this.world.add(points);
      }
    }
    /// A length of the picture at the contact, in the unit of the picture and in ulps.
    tellScale() {
      const pixels = this.size[1] / (2 * Math.tan(this.camera.fov * Math.PI / 360) * this.camera.position.distanceTo(this.controls.target));
      const unit = 2 ** this.data.unit_exponent, real = 90 / pixels / this.zoom;
      this.bar.hidden = !(unit > 0 && unit < Infinity);
      const nice = 10 ** Math.floor(Math.log10(real * unit)), wide = nice / unit;
      const fits = [5, 2, 1].find(k => k * wide <= real) || 1, ulps = fits * wide / this.data.ulp;
      this.bar.firstChild.style.width = `${fits * wide * this.zoom * pixels}px`;
      this.barText.textContent = `${about(fits * nice)}${ulps < 1e6 ? ` = ${about(ulps)} ulp` : ""}`;
    }
    render() { rendererOrNull().render(this.world, this.camera); }
  }

  let current = null;
  function show(host, data, texts) {
    if (current) current.end();
    current = null;
    if (!rendererOrNull()) {
      host.replaceChildren(element("p", {class: "note"}, "This browser draws no picture, because it has no WebGL."));
      return;
    }
    current = new Picture(host, data, texts);
  }
  return {show, current: () => current, redraw: () => { if (current) current.draw(); },
          level: name => { if (current) current.goTo(name); }, end: () => { if (current) current.end(); current = null; }};
})();
