// SPDX-License-Identifier: Apache-2.0
//
// A picture in space: camera, light, mouse and keys, and a way to draw it when something changed.

import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { LineMaterial } from 'three/examples/jsm/lines/LineMaterial.js';
import { LineSegments2 } from 'three/examples/jsm/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/examples/jsm/lines/LineSegmentsGeometry.js';

import { Overlay } from './overlay.js';

// Okabe and Ito 2008: told apart by all kinds of sight.
export const palette = [
  '#56b4e9', '#e69f00', '#009e73', '#f0e442', '#cc79a7', '#0072b2', '#d55e00', '#999999',
];
export const mark = '#d01c8b';
export const manyEdges = 20000; // fewer are no work

export const darkness = window.matchMedia('(prefers-color-scheme: dark)');
export const restful = window.matchMedia('(prefers-reduced-motion: reduce)');

/** Before the next frame, or soon where no frames are drawn. */
export function soon(work) {
  let done = false;
  const once = () => {
    if (done) return;
    done = true;
    work();
  };
  requestAnimationFrame(once);
  setTimeout(once, 60);
}

export class Picture {
  /** `middle` is where the origin of the picture is, `size` the length of its diagonal. */
  constructor(canvas, middle, size) {
    this.middle = middle;
    this.size = size;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, stencil: true, alpha: true, preserveDrawingBuffer: true });
    this.renderer.setClearColor(0, 0); // what is behind is the page's colour
    this.renderer.localClippingEnabled = true;
    this.renderer.autoClear = false;
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(35, 1, size / 1000, size * 20);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener('change', () => this.draw());
    this.scene.add(new THREE.HemisphereLight('#ffffff', '#8a94a3', 1.9));
    this.sun = new THREE.DirectionalLight('#ffffff', 1.6);
    this.scene.add(this.sun);
    canvas.addEventListener('keydown', (e) => this.turnByKey(e));
    this.over = new Overlay(this.renderer);
    this.details = []; // of much work: not in the first picture, nor while pictures take long
  }

  // Small numbers, so that single precision is enough.
  local(p) {
    return p.map((x, k) => x - this.middle[k]);
  }

  /** Segments of a width in pixels, before all else. */
  addLine(color, width, scene = this.scene) {
    const out = new LineSegments2(
      new LineSegmentsGeometry(),
      new LineMaterial({ color, linewidth: width, depthTest: false }),
    );
    out.visible = false;
    out.frustumCulled = false;
    out.renderOrder = 5;
    out.raycast = () => {};
    scene.add(out);
    return out;
  }
  setLine(line, ends) {
    line.geometry.dispose();
    line.visible = ends.length > 0;
    if (ends.length) line.geometry = new LineSegmentsGeometry().setPositions(ends);
  }

  // Arrows turn, plus and minus go nearer and away: like the mouse.
  turnByKey(e) {
    const turns = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const zooms = { '+': 0.9, '=': 0.9, '-': 1 / 0.9 };
    if (!turns[e.key] && !zooms[e.key]) return;
    e.preventDefault();
    const way = this.camera.position.clone().sub(this.controls.target);
    if (turns[e.key]) {
      const at = new THREE.Spherical().setFromVector3(new THREE.Vector3(way.x, way.z, -way.y));
      at.theta += 0.1 * turns[e.key][0];
      at.phi = Math.min(3.1, Math.max(0.04, at.phi + 0.1 * turns[e.key][1]));
      const v = new THREE.Vector3().setFromSpherical(at);
      way.set(v.x, -v.z, v.y);
    } else {
      way.multiplyScalar(zooms[e.key]);
    }
    this.camera.position.copy(this.controls.target).add(way);
    this.controls.update();
    this.draw();
  }

  lookFrom(direction) {
    const d = new THREE.Vector3(...direction).normalize().multiplyScalar(1.75 * this.size);
    this.camera.position.copy(d);
    this.controls.target.set(0, 0, 0);
    this.controls.update();
  }

  /** Goes to see a place of some extent, from the side that the eye is on. */
  flyTo(place, reach) {
    const target = new THREE.Vector3(...this.local(place));
    const way = this.camera.position.clone().sub(this.controls.target).normalize();
    const eye = target.clone().addScaledVector(way, Math.max(2.6 * reach, this.size / 250));
    const from = [this.camera.position.clone(), this.controls.target.clone()];
    const start = performance.now();
    const length = restful.matches ? 1 : 350;
    const step = () => {
      const t = Math.min(1, (performance.now() - start) / length);
      const s = t * t * (3 - 2 * t);
      this.camera.position.lerpVectors(from[0], eye, s);
      this.controls.target.lerpVectors(from[1], target, s);
      this.controls.update();
      this.drawNow();
      if (t < 1 && this.flight === step) soon(step);
    };
    this.flight = step;
    step();
  }

  resize() {
    const { clientWidth: w, clientHeight: h } = this.renderer.domElement;
    const ratio = Math.min(2, window.devicePixelRatio);
    if (this.extent?.join() === [w, h, ratio].join()) return;
    this.extent = [w, h, ratio];
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(w, h, false);
    this.camera.aspect = w / Math.max(1, h);
    // Beside the panel, where there is room for both.
    if (w > 760) this.camera.setViewOffset(w, h, -165, 0, w, h);
    else this.camera.setViewOffset(w, h, 0, -0.2 * h, w, h);
    this.camera.zoom = Math.min(1, 1.1 * this.camera.aspect); // on phones, what is wide
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  draw() {
    this.isStale = true;
    this.drawOver();
  }
  /** Where marks alone have changed. */
  drawOver() {
    if (this.waiting) return;
    this.waiting = true;
    soon(() => {
      if (!this.waiting) return;
      if (this.isStale) this.drawNow();
      else this.drawOverNow();
    });
  }
  drawOverNow() {
    this.waiting = false;
    this.over.render(this.camera, true);
  }
  /** Details follow when nothing has moved for a while, if the last picture is not there yet. */
  drawNow() {
    this.waiting = this.isStale = false;
    clearTimeout(this.resting);
    this.sun.position.copy(this.camera.position).applyAxisAngle(this.camera.up, 0.5);
    const details = this.isDrawn() ? [] : this.details.filter((o) => o.visible);
    for (const o of details) o.visible = false;
    this.render();
    for (const o of details) o.visible = true;
    if (details.length) this.resting = setTimeout(() => this.render(), 150);
  }
  render() {
    const gl = this.renderer.getContext();
    this.renderer.clear();
    this.renderer.render(this.scene, this.camera);
    this.over.keep();
    this.over.render(this.camera, false);
    gl.deleteSync(this.fence ?? null);
    this.fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
  }
  /** Whether the last picture is there, which is known without waiting for it. */
  isDrawn() {
    const gl = this.renderer.getContext();
    return this.fence && gl.getSyncParameter(this.fence, gl.SYNC_STATUS) === gl.SIGNALED;
  }

  /** A ray through a pixel. */
  rayAt(x, y) {
    const { clientWidth: w, clientHeight: h } = this.renderer.domElement;
    const raycaster = new THREE.Raycaster();
    raycaster.setFromCamera(new THREE.Vector2((2 * x) / w - 1, 1 - (2 * y) / h), this.camera);
    return raycaster;
  }
  /** The pixel of a point of the picture. */
  pixelOf(p) {
    const { clientWidth: w, clientHeight: h } = this.renderer.domElement;
    const v = new THREE.Vector3(...p).project(this.camera);
    return [((v.x + 1) * w) / 2, ((1 - v.y) * h) / 2];
  }
}

/** How far a pixel is from a segment between two. */
export function toSegment(p, a, b) {
  const w = [b[0] - a[0], b[1] - a[1]];
  const length = w[0] * w[0] + w[1] * w[1];
  const along = length ? ((p[0] - a[0]) * w[0] + (p[1] - a[1]) * w[1]) / length : 0;
  const t = Math.min(1, Math.max(0, along));
  return Math.hypot(p[0] - a[0] - t * w[0], p[1] - a[1] - t * w[1]);
}

/** Numbers from 0 to 1, always the same ones for a seed. */
export function randomNumbers(seed) {
  let state = BigInt(seed);
  return () => {
    state = (state * 6364136223846793005n + 1442695040888963407n) & 0xffffffffffffffffn;
    return Number(state >> 11n) / 2 ** 53;
  };
}
