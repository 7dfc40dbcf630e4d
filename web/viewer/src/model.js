// SPDX-License-Identifier: Apache-2.0
//
// The boundary on a page: arrays of the engine, and what follows from them.

import { Fraction, Plane, common, vector } from './exact.js';

/** Arrays of the page, in base64 of deflated bytes. */
export class Arrays {
  static async read(base64, places) {
    const text = atob(base64);
    const packed = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) packed[i] = text.charCodeAt(i);
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
    const out = new Arrays();
    out.all = new Uint8Array(await new Response(stream).arrayBuffer());
    out.places = places;
    return out;
  }

  bytes(name) {
    const [at, length] = this.places[name];
    return this.all.subarray(at, at + length);
  }

  /** The first bytes of all numbers come first. */
  doubles(name) {
    const bytes = this.bytes(name);
    const count = bytes.length / 8;
    const together = new Uint8Array(bytes.length);
    for (let b = 0; b < 8; ++b)
      for (let i = 0; i < count; ++i) together[8 * i + b] = bytes[b * count + i];
    return new Float64Array(together.buffer);
  }

  /** Differences, the sign in the last bit, seven bits a byte. */
  integers(name) {
    const bytes = this.bytes(name);
    const out = new Uint32Array(bytes.length);
    let count = 0;
    let last = 0;
    let value = 0;
    let weight = 1;
    for (let i = 0; i < bytes.length; ++i) {
      value += (bytes[i] & 127) * weight;
      weight *= 128;
      if (bytes[i] >= 128) continue;
      last += value % 2 ? -(value + 1) / 2 : value / 2;
      out[count++] = last;
      value = 0;
      weight = 1;
    }
    return out.slice(0, count);
  }
}

export class Model {
  constructor(facts, arrays) {
    this.facts = facts;
    this.points = arrays.doubles('points'); // three a vertex
    this.isExact = arrays.bytes('exact'); // by vertex: the doubles are its coordinates
    this.triangles = arrays.integers('triangles');
    this.edges = arrays.integers('edges'); // two vertices each
    this.faceOperand = arrays.integers('operand');
    this.faceSource = arrays.integers('source');
    this.firstTriangle = arrays.integers('first'); // by face, and one more
    this.faceCount = this.faceOperand.length;
    this.triangleCount = this.triangles.length / 3;
    this.vertexCount = this.points.length / 3;
    this.edgeCount = this.edges.length / 2;
    this.faceOfTriangle = new Uint32Array(this.triangleCount);
    for (let f = 0; f < this.faceCount; ++f)
      this.faceOfTriangle.fill(f, this.firstTriangle[f], this.firstTriangle[f + 1]);
    this.planes = new Map(); // exact ones, as they are asked for
    this.exactPoints = new Map();
    this.findShells();
    this.findBounds();
  }

  point(v) {
    return [this.points[3 * v], this.points[3 * v + 1], this.points[3 * v + 2]];
  }

  listTrianglesOfVertices() {
    this.firstOfVertex = new Uint32Array(this.vertexCount + 1);
    for (const v of this.triangles) ++this.firstOfVertex[v + 1];
    for (let v = 0; v < this.vertexCount; ++v) this.firstOfVertex[v + 1] += this.firstOfVertex[v];
    const fill = this.firstOfVertex.slice();
    this.atVertex = new Uint32Array(this.triangles.length);
    for (let i = 0; i < this.triangles.length; ++i)
      this.atVertex[fill[this.triangles[i]]++] = (i / 3) | 0;
  }

  facesAt(v) {
    if (!this.atVertex) this.listTrianglesOfVertices();
    const out = new Set();
    for (let i = this.firstOfVertex[v]; i < this.firstOfVertex[v + 1]; ++i)
      out.add(this.faceOfTriangle[this.atVertex[i]]);
    return [...out];
  }

  /** The numbers of parts that hang together, by vertex. */
  findShells() {
    const parent = new Uint32Array(this.vertexCount).map((_, i) => i);
    const root = (v) => {
      while (parent[v] !== v) v = parent[v] = parent[parent[v]];
      return v;
    };
    for (let i = 0; i < this.triangles.length; i += 3)
      for (const k of [1, 2]) {
        const a = root(this.triangles[i]);
        const b = root(this.triangles[i + k]);
        if (a !== b) parent[Math.max(a, b)] = Math.min(a, b);
      }
    const numbers = new Map();
    this.shellOfVertex = new Uint32Array(this.vertexCount);
    for (let v = 0; v < this.vertexCount; ++v) {
      const r = root(v);
      if (!numbers.has(r)) numbers.set(r, numbers.size);
      this.shellOfVertex[v] = numbers.get(r);
    }
    this.shellCount = numbers.size;
  }

  findBounds() {
    this.low = [Infinity, Infinity, Infinity];
    this.high = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < this.points.length; ++i) {
      this.low[i % 3] = Math.min(this.low[i % 3], this.points[i]);
      this.high[i % 3] = Math.max(this.high[i % 3], this.points[i]);
    }
    this.size = Math.hypot(...this.high.map((h, k) => h - this.low[k])) || 1;
  }

  /** Edges by their ends; several copies of one edge have one number. */
  edgeBetween(a, b) {
    if (!this.edgeNumbers) {
      this.edgeNumbers = new Map();
      for (let e = this.edgeCount; e-- > 0; )
        this.edgeNumbers.set(this.keyOf(this.edges[2 * e], this.edges[2 * e + 1]), e);
    }
    return this.edgeNumbers.get(this.keyOf(a, b));
  }
  keyOf(a, b) {
    return a < b ? a * this.vertexCount + b : b * this.vertexCount + a;
  }

  /** The plane of a face, exactly: through three of its vertices, or as the engine wrote it. */
  plane(f) {
    let plane = this.planes.get(f);
    if (plane) return plane;
    const written = this.facts.planes[f];
    if (written) {
      const whole = (t) => (t[0] === '-' ? -BigInt('0x' + t.slice(1)) : BigInt('0x' + t));
      const [a, b, c, d] = written.map((t) => new Fraction(whole(t)));
      const offset = new Fraction(-d.n, d.d).times(this.unit());
      plane = new Plane([a, b, c], offset).inLowestTerms();
    } else {
      plane = this.planeOfVertices(f);
    }
    this.planes.set(f, plane);
    return plane;
  }
  unit() {
    const e = this.facts.unit;
    return e >= 0 ? new Fraction(1n << BigInt(e)) : new Fraction(1n, 1n << BigInt(-e));
  }
  planeOfVertices(f) {
    const corners = [];
    for (let t = this.firstTriangle[f]; t < this.firstTriangle[f + 1]; ++t)
      for (let k = 0; k < 3; ++k) {
        const v = this.triangles[3 * t + k];
        if (this.isExact[v] && !corners.includes(v)) corners.push(v);
      }
    const at = corners.map((v) => vector.of(this.point(v)));
    for (let k = 2; k < at.length; ++k) {
      const plane = Plane.through(at[0], at[1], at[k]);
      if (plane) return this.outward(plane, f);
    }
    throw new Error(`face ${f} has no plane`);
  }
  outward(plane, f) {
    const n = this.normal(this.firstTriangle[f]);
    let along = 0;
    for (let k = 0; k < 3; ++k) along += n[k] * plane.normal[k].toNumber();
    if (along >= 0) return plane;
    return new Plane(
      plane.normal.map((x) => new Fraction(-x.n, x.d)),
      new Fraction(-plane.offset.n, plane.offset.d),
    );
  }

  /** Of a triangle, in doubles, of length 1. */
  normal(t) {
    const [a, b, c] = [0, 1, 2].map((k) => this.point(this.triangles[3 * t + k]));
    const u = b.map((x, k) => x - a[k]);
    const w = c.map((x, k) => x - a[k]);
    const n = [u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]];
    const length = Math.hypot(...n) || 1;
    return n.map((x) => x / length);
  }

  /** The common point of three of a vertex's planes; null where all pass through one line. */
  pointOfPlanes(v) {
    let out = this.exactPoints.get(v);
    if (out !== undefined) return out;
    out = null;
    const planes = this.facesAt(v).map((f) => this.plane(f));
    for (let i = 0; i < planes.length && !out; ++i)
      for (let j = 0; j < i && !out; ++j)
        for (let k = 0; k < j && !out; ++k) out = common(planes[i], planes[j], planes[k]);
    this.exactPoints.set(v, out);
    return out;
  }

  /** How the coordinates of a vertex are given: by doubles, by planes, or rounded only. */
  precision(v) {
    if (this.isExact[v]) return 'doubles';
    return this.pointOfPlanes(v) ? 'planes' : 'rounded';
  }

  /** The exact coordinates of a vertex, unless its precision is 'rounded'. */
  exactPoint(v) {
    return (!this.isExact[v] && this.pointOfPlanes(v)) || vector.of(this.point(v));
  }

  /** -1, 0, 1: where a vertex is beside a number along an axis. */
  side(v, axis, at) {
    const x = this.points[3 * v + axis];
    if (this.isExact[v] || Math.abs(x - at) > 1e-12 * (Math.abs(x) + Math.abs(at)))
      return Math.sign(x - at);
    return this.exactPoint(v)[axis].compare(Fraction.of(at));
  }
}
