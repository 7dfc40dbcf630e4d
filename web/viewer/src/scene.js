// SPDX-License-Identifier: Apache-2.0
//
// The picture: faces by operand, edges, marks, a section, parts pulled apart.

import * as THREE from 'three';
import { MeshBVH, acceleratedRaycast } from 'three-mesh-bvh';

import { Picture, manyEdges, mark, palette, toSegment } from './picture.js';

function positionsOf(points, indices, middle) {
  const [x, y, z] = middle;
  const out = new Float32Array(3 * indices.length);
  for (let i = 0; i < indices.length; ++i) {
    const at = 3 * indices[i];
    out[3 * i] = points[at] - x;
    out[3 * i + 1] = points[at + 1] - y;
    out[3 * i + 2] = points[at + 2] - z;
  }
  return out;
}

function geometryOfFaces(m, middle) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute(
    'position',
    new THREE.BufferAttribute(positionsOf(m.points, m.triangles, middle), 3),
  );
  const ofOperand = palette.map((name) => {
    const c = new THREE.Color(name);
    return [c.r * 255, c.g * 255, c.b * 255];
  });
  const colors = new Uint8Array(3 * m.triangles.length);
  for (let t = 0; t < m.triangleCount; ++t) {
    const c = ofOperand[m.faceOperand[m.faceOfTriangle[t]] % palette.length];
    for (let k = 0; k < 9; ++k) colors[9 * t + k] = c[k % 3];
  }
  geometry.setAttribute('color', new THREE.BufferAttribute(colors, 3, true));
  geometry.boundsTree = new MeshBVH(geometry, { indirect: true });
  return geometry;
}

export class Scene extends Picture {
  constructor(canvas, model) {
    const middle = model.low.map((l, k) => (l + model.high[k]) / 2);
    // Before there is a context of WebGL: a browser that has just begun makes one at the same time.
    const geometry = geometryOfFaces(model, middle);
    super(canvas, middle, model.size);
    this.model = model;
    this.plane = new THREE.Plane(new THREE.Vector3(0, 0, -1), 0);
    this.planes = [];
    this.explosion = 0;
    this.addFaces(geometry);
    this.addEdges();
    this.addMarks();
    this.addCap();
    this.lookFrom([1, -1.3, 0.9]);
  }

  addFaces(geometry) {
    this.material = new THREE.MeshLambertMaterial({
      vertexColors: true,
      flatShading: true,
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
    });
    this.faces = new THREE.Mesh(geometry, this.material);
    this.faces.raycast = acceleratedRaycast;
    this.scene.add(this.faces);
  }

  addEdges() {
    const m = this.model;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute(
      'position',
      new THREE.BufferAttribute(positionsOf(m.points, m.edges, this.middle), 3),
    );
    this.edges = new THREE.LineSegments(
      geometry,
      new THREE.LineBasicMaterial({ color: '#1d2733', transparent: true, opacity: 0.55 }),
    );
    this.scene.add(this.edges);
    if (m.edgeCount > manyEdges) this.details.push(this.edges);
  }

  addMarks() {
    this.markedEdge = this.addLine(mark, 4, this.over.scene);
    this.measured = this.addLine('#000000', 2);
    this.loops = this.addLine('#d55e00', 3);
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
      this.over.scene.add(o);
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

  /** Backs are seen where faces are cut or moved apart, and from inside. */
  chooseSide() {
    const { low, high, facts } = this.model;
    const inside = this.camera.position
      .toArray()
      .every((x, k) => Math.abs(x) < 0.51 * (high[k] - low[k]) + this.size / 500);
    const isClosed = Number(facts.volume) > 0 && !this.planes.length && !this.explosion && !inside;
    const side = isClosed ? THREE.FrontSide : THREE.DoubleSide;
    if (side === this.material.side) return;
    this.material.side = side;
    this.material.needsUpdate = true;
  }
  render() {
    this.chooseSide();
    super.render();
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
      this.setLine(this.loops, ends);
    }
    this.draw();
  }

  /** The inputs of a boolean, to be seen through. */
  addGhosts(inputs) {
    this.ghosts = new THREE.Group();
    inputs.forEach(({ points, triangles }, i) => {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute(
        'position',
        new THREE.BufferAttribute(positionsOf(points, triangles, this.middle), 3),
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
    this.drawOver();
  }

  /** The first triangle on a ray that is not cut away: its number and the point. */
  hit(raycaster) {
    this.chooseSide();
    const hits = raycaster.intersectObject(this.faces, false);
    for (const h of hits)
      if (this.planes.every((p) => p.distanceToPoint(h.point) >= 0))
        return { triangle: h.faceIndex, point: h.point };
    return null;
  }

  /** The vertex, edge or face that is seen at a pixel, vertices and edges within some pixels. */
  pick(x, y, reach = 6) {
    const found = this.hit(this.rayAt(x, y));
    if (!found) return null;
    const m = this.model;
    const face = m.faceOfTriangle[found.triangle];
    const onScreen = (v) => this.pixelOf(this.shown(v));
    const corners = [0, 1, 2].map((k) => m.triangles[3 * found.triangle + k]);
    const at = corners.map(onScreen);
    for (let k = 0; k < 3; ++k)
      if (Math.hypot(at[k][0] - x, at[k][1] - y) <= reach)
        return { kind: 'vertex', number: corners[k], face, triangle: found.triangle };
    for (let k = 0; k < 3; ++k) {
      const edge = m.edgeBetween(corners[k], corners[(k + 1) % 3]);
      if (edge === undefined) continue;
      if (toSegment([x, y], at[k], at[(k + 1) % 3]) <= reach / 2)
        return { kind: 'edge', number: edge, face, triangle: found.triangle };
    }
    return { kind: 'face', number: face, face, triangle: found.triangle };
  }
}
