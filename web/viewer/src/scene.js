// SPDX-License-Identifier: Apache-2.0
//
// The picture: faces by operand, edges, marks, a section, parts pulled apart.

import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { LineMaterial } from 'three/examples/jsm/lines/LineMaterial.js';
import { LineSegments2 } from 'three/examples/jsm/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/examples/jsm/lines/LineSegmentsGeometry.js';
import { MeshBVH, acceleratedRaycast } from 'three-mesh-bvh';

// Okabe and Ito 2008: told apart by all kinds of sight.
export const palette = [
  '#56b4e9', '#e69f00', '#009e73', '#f0e442', '#cc79a7', '#0072b2', '#d55e00', '#999999',
];
const mark = '#d01c8b';

export class Scene {
  constructor(canvas, model) {
    this.model = model;
    this.middle = model.low.map((l, k) => (l + model.high[k]) / 2);
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, stencil: true, alpha: true });
    this.renderer.setClearColor(0, 0); // what is behind is the page's colour
    this.renderer.localClippingEnabled = true;
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(35, 1, model.size / 1000, model.size * 20);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener('change', () => this.draw());
    this.plane = new THREE.Plane(new THREE.Vector3(0, 0, -1), 0);
    this.planes = [];
    this.explosion = 0;
    this.addLights();
    this.addFaces();
    this.addEdges();
    this.addMarks();
    this.addCap();
    this.lookFrom([1, -1.3, 0.9]);
  }

  // Small numbers, so that single precision is enough.
  local(p) {
    return p.map((x, k) => x - this.middle[k]);
  }

  addLights() {
    this.scene.add(new THREE.HemisphereLight('#ffffff', '#8a94a3', 1.9));
    this.sun = new THREE.DirectionalLight('#ffffff', 1.6);
    this.scene.add(this.sun);
  }

  positionsOf(points, triangles) {
    const out = new Float32Array(3 * triangles.length);
    for (let i = 0; i < triangles.length; ++i)
      for (let k = 0; k < 3; ++k) out[3 * i + k] = points[3 * triangles[i] + k] - this.middle[k];
    return out;
  }

  addFaces() {
    const m = this.model;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute(
      'position',
      new THREE.BufferAttribute(this.positionsOf(m.points, m.triangles), 3),
    );
    const colors = new Uint8Array(3 * m.triangles.length);
    const c = new THREE.Color();
    for (let t = 0; t < m.triangleCount; ++t) {
      c.set(palette[m.faceOperand[m.faceOfTriangle[t]] % palette.length]);
      for (let k = 0; k < 3; ++k)
        colors.set([c.r * 255, c.g * 255, c.b * 255], 9 * t + 3 * k);
    }
    geometry.setAttribute('color', new THREE.BufferAttribute(colors, 3, true));
    this.material = new THREE.MeshLambertMaterial({
      vertexColors: true,
      flatShading: true,
      side: THREE.DoubleSide,
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
    });
    this.faces = new THREE.Mesh(geometry, this.material);
    this.faces.raycast = acceleratedRaycast;
    geometry.boundsTree = new MeshBVH(geometry, { indirect: true });
    this.scene.add(this.faces);
  }

  addEdges() {
    const m = this.model;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute(
      'position',
      new THREE.BufferAttribute(this.positionsOf(m.points, m.edges), 3),
    );
    this.edges = new THREE.LineSegments(
      geometry,
      new THREE.LineBasicMaterial({ color: '#1d2733', transparent: true, opacity: 0.55 }),
    );
    this.scene.add(this.edges);
  }

  addMarks() {
    const line = (color, width) => {
      const out = new LineSegments2(
        new LineSegmentsGeometry(),
        new LineMaterial({ color, linewidth: width, depthTest: false }),
      );
      out.visible = false;
      out.frustumCulled = false;
      out.renderOrder = 5;
      this.scene.add(out);
      return out;
    };
    this.markedEdge = line(mark, 4);
    this.measured = line('#000000', 2);
    this.loops = line('#d55e00', 3);
    this.markedFace = new THREE.Mesh(
      new THREE.BufferGeometry(),
      new THREE.MeshBasicMaterial({
        color: mark, transparent: true, opacity: 0.55, side: THREE.DoubleSide, depthWrite: false,
      }),
    );
    this.markedPoint = new THREE.Points(
      new THREE.BufferGeometry(),
      new THREE.PointsMaterial({ color: mark, size: 11, sizeAttenuation: false, depthTest: false }),
    );
    this.markedPoint.renderOrder = 6;
    for (const o of [this.markedFace, this.markedPoint]) {
      o.visible = false;
      o.frustumCulled = false;
      this.scene.add(o);
    }
  }

  // What is cut open is closed by the plane where back faces outnumber front faces behind it.
  addCap() {
    const pass = (side, operation) => {
      const material = new THREE.MeshBasicMaterial({
        side, depthWrite: false, depthTest: false, colorWrite: false, stencilWrite: true,
        stencilFunc: THREE.AlwaysStencilFunc,
        stencilFail: operation, stencilZFail: operation, stencilZPass: operation,
        clippingPlanes: [this.plane],
      });
      const mesh = new THREE.Mesh(this.faces.geometry, material);
      mesh.raycast = () => {};
      mesh.renderOrder = 1;
      return mesh;
    };
    this.cap = new THREE.Group();
    this.cap.add(pass(THREE.BackSide, THREE.IncrementWrapStencilOp));
    this.cap.add(pass(THREE.FrontSide, THREE.DecrementWrapStencilOp));
    const size = 2 * this.model.size;
    this.capPlane = new THREE.Mesh(
      new THREE.PlaneGeometry(size, size),
      new THREE.MeshBasicMaterial({
        color: '#f4d9b8', side: THREE.DoubleSide, stencilWrite: true,
        stencilFunc: THREE.NotEqualStencilFunc, stencilRef: 0,
        stencilFail: THREE.ZeroStencilOp, stencilZFail: THREE.ZeroStencilOp,
        stencilZPass: THREE.ZeroStencilOp,
      }),
    );
    this.capPlane.raycast = () => {};
    this.capPlane.renderOrder = 2;
    this.cap.add(this.capPlane);
    this.cap.visible = false;
    this.scene.add(this.cap);
  }

  /** Cuts what lies above `at` along an axis away; nothing where the axis is negative. */
  cut(axis, at, loops) {
    const on = axis >= 0;
    this.planes = on ? [this.plane] : [];
    this.cap.visible = on;
    this.loops.visible = on;
    this.material.clippingPlanes = this.edges.material.clippingPlanes = on ? this.planes : null;
    if (on) {
      const n = new THREE.Vector3().setComponent(axis, -1);
      const level = at - this.middle[axis];
      this.plane.set(n, level);
      this.capPlane.position.set(0, 0, 0).setComponent(axis, level);
      this.capPlane.lookAt(this.capPlane.position.clone().add(n));
      const ends = [];
      for (const loop of loops)
        loop.forEach((p, i) =>
          ends.push(...this.local(p), ...this.local(loop[(i + 1) % loop.length])),
        );
      this.loops.visible = ends.length > 0;
      if (ends.length) this.setLine(this.loops, ends);
    }
    this.draw();
  }

  setLine(line, ends) {
    line.geometry.dispose();
    line.geometry = new LineSegmentsGeometry().setPositions(ends);
    line.visible = true;
  }

  /** The inputs of a boolean, to be seen through. */
  addGhosts(inputs) {
    this.ghosts = new THREE.Group();
    inputs.forEach(({ points, triangles }, i) => {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute(
        'position',
        new THREE.BufferAttribute(this.positionsOf(points, triangles), 3),
      );
      geometry.computeVertexNormals();
      const mesh = new THREE.Mesh(
        geometry,
        new THREE.MeshLambertMaterial({
          color: palette[i % palette.length], transparent: true, opacity: 0.2,
          depthWrite: false, side: THREE.DoubleSide, flatShading: true,
        }),
      );
      mesh.raycast = () => {};
      mesh.renderOrder = 3;
      this.ghosts.add(mesh);
    });
    this.ghosts.visible = false;
    this.scene.add(this.ghosts);
  }

  /** Moves parts that hang together away from the middle. */
  explode(amount) {
    this.explosion = amount;
    const m = this.model;
    if (!this.shellMiddles) {
      const sums = Array.from({ length: m.shellCount }, () => [0, 0, 0, 0]);
      for (let v = 0; v < m.vertexCount; ++v) {
        const s = sums[m.shellOfVertex[v]];
        for (let k = 0; k < 3; ++k) s[k] += m.points[3 * v + k] - this.middle[k];
        ++s[3];
      }
      this.shellMiddles = sums.map((s) => [s[0] / s[3], s[1] / s[3], s[2] / s[3]]);
    }
    const place = (attribute, indices) => {
      for (let i = 0; i < indices.length; ++i) {
        const v = indices[i];
        const away = this.shellMiddles[m.shellOfVertex[v]];
        for (let k = 0; k < 3; ++k)
          attribute.array[3 * i + k] = m.points[3 * v + k] - this.middle[k] + amount * away[k];
      }
      attribute.needsUpdate = true;
    };
    place(this.faces.geometry.attributes.position, m.triangles);
    place(this.edges.geometry.attributes.position, m.edges);
    this.faces.geometry.boundsTree.refit();
    this.faces.geometry.computeBoundingSphere();
    this.draw();
  }
  shown(v) {
    const away = this.explosion ? this.shellMiddles[this.model.shellOfVertex[v]] : [0, 0, 0];
    return this.local(this.model.point(v)).map((x, k) => x + this.explosion * away[k]);
  }

  /** Marks a vertex, an edge or a face, or nothing. */
  highlight(item) {
    this.markedPoint.visible = this.markedEdge.visible = this.markedFace.visible = false;
    const m = this.model;
    if (item && item.kind === 'vertex') {
      this.markedPoint.geometry.setAttribute(
        'position',
        new THREE.Float32BufferAttribute(this.shown(item.number), 3),
      );
      this.markedPoint.visible = true;
    } else if (item && item.kind === 'edge') {
      const ends = [m.edges[2 * item.number], m.edges[2 * item.number + 1]];
      this.setLine(this.markedEdge, ends.flatMap((v) => this.shown(v)));
    } else if (item) {
      const corners = [];
      for (let i = 3 * m.firstTriangle[item.number]; i < 3 * m.firstTriangle[item.number + 1]; ++i)
        corners.push(...this.shown(m.triangles[i]));
      this.markedFace.geometry.dispose();
      this.markedFace.geometry = new THREE.BufferGeometry().setAttribute(
        'position',
        new THREE.Float32BufferAttribute(corners, 3),
      );
      this.markedFace.visible = true;
    }
    this.draw();
  }

  /** The first triangle on a ray that is not cut away: its number and the point. */
  hit(raycaster) {
    const hits = raycaster.intersectObject(this.faces, false);
    for (const h of hits)
      if (this.planes.every((p) => p.distanceToPoint(h.point) >= 0))
        return { triangle: h.faceIndex, point: h.point };
    return null;
  }

  /** The vertex, edge or face that is seen at a pixel, vertices and edges within some pixels. */
  pick(x, y, reach = 6) {
    const { clientWidth: w, clientHeight: h } = this.renderer.domElement;
    const raycaster = new THREE.Raycaster();
    raycaster.setFromCamera(new THREE.Vector2((2 * x) / w - 1, 1 - (2 * y) / h), this.camera);
    const found = this.hit(raycaster);
    if (!found) return null;
    const m = this.model;
    const face = m.faceOfTriangle[found.triangle];
    const onScreen = (v) => {
      const p = new THREE.Vector3(...this.shown(v)).project(this.camera);
      return [((p.x + 1) * w) / 2, ((1 - p.y) * h) / 2];
    };
    const corners = [0, 1, 2].map((k) => m.triangles[3 * found.triangle + k]);
    const at = corners.map(onScreen);
    for (let k = 0; k < 3; ++k)
      if (Math.hypot(at[k][0] - x, at[k][1] - y) <= reach)
        return { kind: 'vertex', number: corners[k], face };
    for (let k = 0; k < 3; ++k) {
      const edge = m.edgeBetween(corners[k], corners[(k + 1) % 3]);
      if (edge === undefined) continue;
      if (toSegment([x, y], at[k], at[(k + 1) % 3]) <= reach / 2)
        return { kind: 'edge', number: edge, face };
    }
    return { kind: 'face', number: face, face };
  }

  lookFrom(direction) {
    const d = new THREE.Vector3(...direction).normalize().multiplyScalar(1.75 * this.model.size);
    this.camera.position.copy(d);
    this.controls.target.set(0, 0, 0);
    this.controls.update();
  }

  resize() {
    const { clientWidth: w, clientHeight: h } = this.renderer.domElement;
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.renderer.setSize(w, h, false);
    this.camera.aspect = w / Math.max(1, h);
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  draw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => this.drawNow());
  }
  drawNow() {
    this.waiting = false;
    this.sun.position.copy(this.camera.position).applyAxisAngle(this.camera.up, 0.5);
    this.renderer.render(this.scene, this.camera);
  }
}

function toSegment(p, a, b) {
  const w = [b[0] - a[0], b[1] - a[1]];
  const length = w[0] * w[0] + w[1] * w[1];
  const along = length ? ((p[0] - a[0]) * w[0] + (p[1] - a[1]) * w[1]) / length : 0;
  const t = Math.min(1, Math.max(0, along));
  return Math.hypot(p[0] - a[0] - t * w[0], p[1] - a[1] - t * w[1]);
}
