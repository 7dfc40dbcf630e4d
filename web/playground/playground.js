// SPDX-License-Identifier: Apache-2.0
//
// The playground: two solids, one of which is dragged; their boolean and their exact relation after every
// step. `window.playground` is for programs that drive the page.

import { distance, init, interfere, Pose, Solid } from './trisect.js';
import { palette, Picture } from './picture.js';

const byId = (id) => document.getElementById(id);
const shapes = {
  box: () => Solid.box([-1, -1, -1], [1, 1, 1]),
  ball: () => Solid.sphere(1.1, 3),
  cylinder: () => Solid.cylinder(0.5, 3, 48).translate([0, 0, -1.5]),
  cone: () => Solid.cone(1, 0.25, 2, 48).translate([0, 0, -1]),
  torus: () => Solid.torus(1, 0.375, 48, 24),
  'small box': () => Solid.box([-0.5, -0.5, -0.5], [0.5, 0.5, 0.5]),
};

class Playground {
  constructor() {
    this.at = [1, -1, 0.5];
    this.isWhole = false;
    this.picture = new Picture(byId('view'));
    this.shown = this.picture.add();
    this.ghost = this.picture.add();
    this.ghost.isGhost = true;
    for (const [id, chosen] of [['first', 'box'], ['second', 'ball']]) {
      byId(id).append(...Object.keys(shapes).map((name) => new Option(name, name, false, name === chosen)));
      byId(id).addEventListener('change', () => this.choose());
    }
    byId('operation').addEventListener('change', () => this.update());
    byId('evaluate').addEventListener('click', () => this.evaluate(byId('csg').value));
    this.listen();
    this.choose();
  }

  choose() {
    this.setSolids(shapes[byId('first').value](), shapes[byId('second').value]());
  }
  evaluate(text) {
    try {
      this.setSolids(Solid.fromCsg(text), shapes[byId('second').value]());
    } catch (error) {
      byId('error').textContent = error.message;
    }
  }
  setSolids(first, second) {
    [this.first, this.second] = [first, second];
    this.picture.fill(this.ghost, second.mesh(), () => [...palette[1], 0.22]);
    this.update();
  }

  update() {
    byId('error').textContent = '';
    try {
      this.compute();
    } catch (error) {
      byId('error').textContent = error.message;
    }
    this.draw();
  }
  compute() {
    const start = performance.now();
    const moved = this.second.translate(this.at);
    const result = this.first[byId('operation').value](moved);
    const mesh = result.mesh();
    const time = performance.now() - start;
    byId('volume').textContent = result.volume;
    byId('triangles').textContent = mesh.faces.length / 3;
    byId('time').textContent = `${time.toFixed(1)} ms`;
    const relation = this.isWhole ? this.relate() : null;
    const ofFirst = new Set();
    if (relation !== 'equal') this.namesOf(this.first, ofFirst);
    this.picture.fill(this.shown, mesh, (t) => [...palette[ofFirst.has(mesh.sources[2 * t]) ? 0 : 1], 1]);
    for (const object of [moved, result]) object.delete();
  }
  relate() {
    const pose = Pose.translation(this.at);
    const relation = interfere(this.first, null, this.second, pose);
    byId('relation').textContent = relation;
    byId('distance').textContent = relation === 'disjoint' ? distance(this.first, null, this.second, pose).upper.toPrecision(6) : '0';
    pose.delete();
    return relation;
  }
  /** What sources of results call the operands of a solid. */
  namesOf(solid, names) {
    const { sources } = solid.mesh();
    for (let i = 0; i < sources.length; i += 2) names.add(sources[i]);
  }
  draw() {
    this.ghost.shift = this.at;
    this.picture.draw();
  }

  move(by) {
    this.at = this.at.map((x, k) => x + by[k]);
    this.update();
  }

  /** The place of the second solid under a pixel, or null. */
  grab(x, y) {
    const { eye, along } = this.picture.ray(x, y);
    const hit = this.second.firstHit(eye.map((e, k) => e - this.at[k]), along);
    const other = this.first.firstHit(eye, along);
    if (hit === null || (other !== null && other.parameter < hit.parameter && byId('operation').value !== 'difference')) return null;
    return { depth: hit.parameter, from: [...this.at], start: along };
  }
  drag(grip, x, y) {
    const { along } = this.picture.ray(x, y);
    const step = byId('snap').checked ? 0.25 : 1 / 1024;
    const to = grip.from.map((f, k) => Math.round((f + grip.depth * (along[k] - grip.start[k])) / step) * step);
    if (to.every((t, k) => t === this.at[k])) return;
    this.at = to;
    this.update();
  }

  listen() {
    const canvas = byId('view');
    let grip = null;
    canvas.addEventListener('pointerdown', (e) => {
      canvas.setPointerCapture(e.pointerId);
      grip = this.grab(e.offsetX, e.offsetY) ?? 'camera';
    });
    canvas.addEventListener('pointerup', () => (grip = null));
    canvas.addEventListener('pointermove', (e) => {
      if (grip === null) return;
      if (grip !== 'camera') return this.drag(grip, e.offsetX, e.offsetY);
      this.picture.turn -= e.movementX * 0.01;
      this.picture.tilt = Math.min(1.5, Math.max(-1.5, this.picture.tilt + e.movementY * 0.01));
      this.draw();
    });
    canvas.addEventListener('wheel', (e) => {
      e.preventDefault();
      this.picture.distance = Math.min(40, Math.max(2, this.picture.distance * Math.exp(e.deltaY * 0.001)));
      this.draw();
    }, { passive: false });
    const steps = {
      ArrowLeft: [-0.25, 0, 0], ArrowRight: [0.25, 0, 0], ArrowDown: [0, -0.25, 0], ArrowUp: [0, 0.25, 0],
      PageDown: [0, 0, -0.25], PageUp: [0, 0, 0.25],
    };
    canvas.addEventListener('keydown', (e) => {
      if (!steps[e.key]) return;
      e.preventDefault();
      this.move(steps[e.key]);
    });
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  /** What the page says now. */
  state() {
    const text = (id) => byId(id).textContent;
    return {
      at: this.at, relation: text('relation'), volume: Number(text('volume')), triangles: Number(text('triangles')),
      time: text('time'), error: text('error'),
    };
  }
}

try {
  // Solids and booleans are there before relations and programs.
  await init(undefined, { more: false });
  window.playground = new Playground();
  await init();
  window.playground.isWhole = true;
  window.playground.update();
  document.title = 'Trisect playground: ready';
} catch (error) {
  byId('error').textContent = error.message;
  document.title = 'Trisect playground: failed';
}
