// SPDX-License-Identifier: Apache-2.0
//
// Partitions of space: the tree of cells, and the tree whose cuts are planes of faces. On which
// side of a cut a point is, is exact.

import { Fraction } from './exact.js';

const axes = ['x', 'y', 'z'];
const power = (e) => (e >= 0 ? new Fraction(1n << BigInt(e)) : new Fraction(1n, 1n << BigInt(-e)));

/** Cuts across axes. A leaf is inside, outside, or lists facets. */
export class CellTree {
  constructor(facts, text) {
    this.nodes = JSON.parse(text);
    this.unit = power(facts.unit).over(new Fraction(BigInt(facts.scale)));
    this.root = 0;
    this.label = 'cells: planes across axes';
    this.hasOn = false;
    this.findDepths();
  }

  findDepths() {
    this.depth = 0;
    this.cuts = 0;
    const stack = [[0, 0]];
    while (stack.length) {
      const [i, d] = stack.pop();
      this.depth = Math.max(this.depth, d);
      if (this.isLeaf(i)) continue;
      ++this.cuts;
      stack.push([this.nodes[i][2], d + 1], [this.nodes[i][3], d + 1]);
    }
  }

  isLeaf(i) {
    return this.nodes[i][0] < 0;
  }
  leaf(i) {
    const [kind, facets, inside, arranged] = this.nodes[i];
    if (kind === -2) return { kind: 'deeper', text: 'the tree goes on, deeper than this page' };
    if (facets)
      return {
        kind: 'facets',
        facets,
        text:
          `a leaf with ${facets} facet${facets === 1 ? '' : 's'}` +
          (arranged ? ', where operands meet' : '') + ': they decide',
      };
    return { kind: inside ? 'inside' : 'outside', text: `a leaf ${inside ? 'inside' : 'outside'}` };
  }
  dimension() {
    return 3;
  }
  child(i, side) {
    return this.nodes[i][side < 0 ? 2 : 3];
  }
  position(i) {
    return new Fraction(BigInt(this.nodes[i][1])).times(this.unit);
  }
  cut(i) {
    const normal = [0, 0, 0];
    normal[this.nodes[i][0]] = 1;
    return { normal, offset: this.position(i).toNumber() };
  }
  cutText(i) {
    return `${axes[this.nodes[i][0]]} = ${Number(this.cut(i).offset.toPrecision(8))}`;
  }
  side(i, p) {
    const x = p[this.nodes[i][0]];
    const at = this.cut(i).offset;
    if (Math.abs(x - at) > 1e-12 * (Math.abs(x) + Math.abs(at))) return Math.sign(x - at);
    return Fraction.of(x).compare(this.position(i));
  }
}

const leafKinds = ['outside', 'inside', 'face', 'edge', 'vertex'];

/** Cuts by planes of faces; what lies in a cut is a tree of its own (Vanecek 1991). */
export class PlaneTree {
  constructor(facts, text) {
    const { root, planes, nodes } = JSON.parse(text);
    const whole = (t) => (t[0] === '-' ? -BigInt('0x' + t.slice(1)) : BigInt('0x' + t));
    this.root = root;
    this.nodes = nodes;
    this.planes = planes.map((p) => (p ? p.map((t) => new Fraction(whole(t))) : null));
    const unit = power(facts.unit);
    for (const p of this.planes) if (p) p[3] = p[3].times(unit);
    // Of length 1 or so, for doubles.
    this.near = this.planes.map((p) => {
      if (!p) return null;
      const largest = p.slice(0, 3).reduce((m, x) => (abs(x.n) > m ? abs(x.n) : m), 0n);
      const scale = new Fraction(1n, largest);
      const n = p.map((x) => x.times(scale).toNumber());
      return { normal: n.slice(0, 3), offset: -n[3] };
    });
    this.label = 'planes of faces (BREP-INDEX)';
    this.hasOn = true;
    this.findDepths();
  }

  // Of space alone: what lies in cuts is not counted.
  findDepths() {
    this.depth = 0;
    this.cuts = 0;
    const stack = [[this.root, 0]];
    while (stack.length) {
      const [r, d] = stack.pop();
      this.depth = Math.max(this.depth, d);
      if (this.isLeaf(r)) continue;
      ++this.cuts;
      stack.push([this.nodes[r][1], d + 1], [this.nodes[r][3], d + 1]);
    }
  }

  isLeaf(r) {
    return r < 0;
  }
  leaf(r) {
    const n = -1 - r;
    const kind = leafKinds[n % 5];
    if (n % 5 < 2) return { kind, text: kind };
    const entity = Math.floor(n / 5);
    return { kind, entity, text: `on ${kind} ${entity}` };
  }
  dimension(r) {
    return this.nodes[r][4];
  }
  child(r, side) {
    return this.nodes[r][side < 0 ? 1 : side > 0 ? 3 : 2];
  }
  cut(r) {
    return this.near[this.nodes[r][0]];
  }
  cutText(r) {
    const { normal, offset } = this.cut(r);
    const number = (x) => String(Number(Math.abs(x).toPrecision(5)));
    let out = '';
    normal.forEach((x, k) => {
      if (x === 0) return;
      const size = Math.abs(x) === 1 ? '' : number(x) + ' ';
      out += (x < 0 ? (out ? ' − ' : '−') : out ? ' + ' : '') + size + axes[k];
    });
    return `${out} = ${offset < 0 ? '−' : ''}${number(offset)}`;
  }
  side(r, p) {
    const { normal, offset } = this.cut(r);
    const terms = [normal[0] * p[0], normal[1] * p[1], normal[2] * p[2], -offset];
    const sum = terms[0] + terms[1] + terms[2] + terms[3];
    if (Math.abs(sum) > 1e-12 * terms.reduce((s, x) => s + Math.abs(x), 0)) return Math.sign(sum);
    const plane = this.planes[this.nodes[r][0]];
    let exact = plane[3];
    for (let k = 0; k < 3; ++k) exact = exact.plus(plane[k].times(Fraction.of(p[k])));
    return exact.sign();
  }
}

function abs(a) {
  return a < 0n ? -a : a;
}
