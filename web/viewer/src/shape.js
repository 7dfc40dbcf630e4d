// SPDX-License-Identifier: Apache-2.0
//
// Surfaces that bodies share: triangles of numbered faces, with edges.

import * as THREE from 'three';
import { MeshBVH } from 'three-mesh-bvh';

export class Shape {
  constructor(arrays, number) {
    this.points = arrays.doubles(`points${number}`);
    this.triangles = arrays.integers(`triangles${number}`);
    this.faces = arrays.integers(`faces${number}`); // by triangle, ascending
    this.source = arrays.integers(`source${number}`); // by face, or empty
    this.edges = arrays.integers(`edges${number}`);
    this.vertexCount = this.points.length / 3;
    this.hasEdgeNumbers = this.edges.length > 0;
    if (!this.hasEdgeNumbers) this.edges = this.edgesBetweenFaces();
    this.findBounds();
    this.geometry = new THREE.BufferGeometry();
    this.geometry.setAttribute(
      'position',
      new THREE.BufferAttribute(this.positionsOf(this.triangles), 3),
    );
    this.geometry.boundsTree = new MeshBVH(this.geometry, { indirect: true });
    this.lines = new THREE.BufferGeometry();
    this.lines.setAttribute(
      'position',
      new THREE.BufferAttribute(this.positionsOf(this.edges), 3),
    );
  }

  point(v) {
    return [this.points[3 * v], this.points[3 * v + 1], this.points[3 * v + 2]];
  }

  // Single precision about the middle.
  positionsOf(vertices) {
    const out = new Float32Array(3 * vertices.length);
    for (let i = 0; i < vertices.length; ++i)
      for (let k = 0; k < 3; ++k)
        out[3 * i + k] = this.points[3 * vertices[i] + k] - this.middle[k];
    return out;
  }

  findBounds() {
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (const v of this.triangles)
      for (let k = 0; k < 3; ++k) {
        const x = this.points[3 * v + k];
        if (x < low[k]) low[k] = x;
        if (x > high[k]) high[k] = x;
      }
    this.isEmpty = this.triangles.length === 0;
    this.low = this.isEmpty ? [0, 0, 0] : low;
    this.high = this.isEmpty ? [0, 0, 0] : high;
    this.middle = this.low.map((l, k) => (l + this.high[k]) / 2);
  }

  keyOf(a, b) {
    return a < b ? a * this.vertexCount + b : b * this.vertexCount + a;
  }

  edgesBetweenFaces() {
    const seen = new Map(); // an edge, and the face at it
    const out = new Set();
    for (let i = 0; i < this.triangles.length; ++i) {
      const t = (i / 3) | 0;
      const key = this.keyOf(this.triangles[i], this.triangles[i % 3 === 2 ? i - 2 : i + 1]);
      const before = seen.get(key);
      if (before === this.faces[t]) out.delete(key); // a diagonal
      else out.add(key);
      if (before === undefined) seen.set(key, this.faces[t]);
    }
    const ends = new Uint32Array(2 * out.size);
    let at = 0;
    for (const key of out) {
      ends[at++] = Math.floor(key / this.vertexCount);
      ends[at++] = key % this.vertexCount;
    }
    return ends;
  }

  /** The number of an edge; nothing for diagonals, and where edges have none. */
  edgeBetween(a, b) {
    if (!this.hasEdgeNumbers) return undefined;
    if (!this.edgeNumbers) {
      this.edgeNumbers = new Map();
      for (let e = this.edges.length / 2; e-- > 0; )
        this.edgeNumbers.set(this.keyOf(this.edges[2 * e], this.edges[2 * e + 1]), e);
    }
    return this.edgeNumbers.get(this.keyOf(a, b));
  }

  /** The triangles of a face: the first one and the one after the last. */
  trianglesOf(face) {
    const lowest = (value) => {
      let [a, b] = [0, this.faces.length];
      while (a < b) {
        const m = (a + b) >> 1;
        if (this.faces[m] < value) a = m + 1;
        else b = m;
      }
      return a;
    };
    return [lowest(face), lowest(face + 1)];
  }

  /** Corners of a face's triangles, about the middle. */
  positionsOfFace(face) {
    const [first, end] = this.trianglesOf(face);
    return this.positionsOf(this.triangles.subarray(3 * first, 3 * end));
  }

  /** How often the surface winds around a point: the sum of the solid angles of all triangles. */
  windingNumber(p) {
    let sum = 0;
    for (let i = 0; i < this.triangles.length; i += 3) {
      const [a, b, c] = [0, 1, 2].map((k) => {
        const q = this.point(this.triangles[i + k]);
        return [q[0] - p[0], q[1] - p[1], q[2] - p[2]];
      });
      const [x, y, z] = [a, b, c].map((v) => Math.hypot(...v));
      const dot = (u, v) => u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
      const det =
        a[0] * (b[1] * c[2] - b[2] * c[1]) +
        a[1] * (b[2] * c[0] - b[0] * c[2]) +
        a[2] * (b[0] * c[1] - b[1] * c[0]);
      sum += Math.atan2(det, x * y * z + dot(a, b) * z + dot(b, c) * x + dot(c, a) * y);
    }
    return sum / (2 * Math.PI);
  }
}
