// SPDX-License-Identifier: Apache-2.0
//
// The distance of two vertices, edges or faces. The nearest parts of both are found in doubles;
// their distance is exact.

import { Fraction, vector } from './exact.js';

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];

function partsOf(model, item) {
  if (item.kind === 'vertex') return [[item.number]];
  if (item.kind === 'edge') return [[model.edges[2 * item.number], model.edges[2 * item.number + 1]]];
  const out = [];
  for (let t = model.firstTriangle[item.number]; t < model.firstTriangle[item.number + 1]; ++t)
    out.push([...model.triangles.subarray(3 * t, 3 * t + 3)]);
  return out;
}

// Points, segments and triangles contain these flats, of which the nearest points are looked for.
function flatsOf(part) {
  const out = part.map((v) => [v]);
  if (part.length === 2) out.push(part);
  if (part.length === 3)
    out.push([part[0], part[1]], [part[1], part[2]], [part[2], part[0]], part);
  return out;
}

// Numbers of one kind: doubles or fractions.
const doubles = {
  minus,
  dot,
  zero: 0,
  sub: (a, b) => a - b,
  mul: (a, b) => a * b,
  div: (a, b) => a / b,
  sign: Math.sign,
};
const fractions = {
  minus: vector.minus,
  dot: vector.dot,
  zero: new Fraction(0n),
  sub: (a, b) => a.minus(b),
  mul: (a, b) => a.times(b),
  div: (a, b) => a.over(b),
  sign: (a) => a.sign(),
};

// The square of the distance of the flats through two sets of points, and whether the nearest
// points are within both. Solves for the weights by Gauss; nothing where the flats are parallel.
function squaredDistance(p, q, field) {
  const { minus: sub, dot: product, zero } = field;
  const ways = [...p.slice(1).map((x) => sub(x, p[0])), ...q.slice(1).map((x) => sub(q[0], x))];
  const start = sub(p[0], q[0]);
  const n = ways.length;
  const rows = ways.map((u) => [...ways.map((w) => product(u, w)), field.sub(zero, product(u, start))]);
  for (let i = 0; i < n; ++i) {
    let pivot = i;
    while (pivot < n && field.sign(rows[pivot][i]) === 0) ++pivot;
    if (pivot === n) return null;
    [rows[i], rows[pivot]] = [rows[pivot], rows[i]];
    for (let j = 0; j < n; ++j) {
      if (j === i || field.sign(rows[j][i]) === 0) continue;
      const factor = field.div(rows[j][i], rows[i][i]);
      for (let k = i; k <= n; ++k)
        rows[j][k] = field.sub(rows[j][k], field.mul(factor, rows[i][k]));
    }
  }
  const weights = rows.map((r, i) => field.div(r[n], r[i]));
  const one = field === doubles ? 1 : new Fraction(1n);
  const isInside = (list) =>
    list.every((w) => field.sign(w) >= 0) &&
    field.sign(list.reduce((left, w) => field.sub(left, w), one)) >= 0;
  const inside =
    isInside(weights.slice(0, p.length - 1)) && isInside(weights.slice(p.length - 1));
  let apart = start;
  weights.forEach((w, i) => {
    apart = apart.map((x, k) => field.sub(x, field.sub(zero, field.mul(w, ways[i][k]))));
  });
  return { square: product(apart, apart), inside };
}

/** The pairs of triangles that a measurement looks at, at most. */
const mostPairs = 1e6;

/**
 * The distance of two entities and its exact square, `rounded` where a vertex that it follows from
 * is; nothing for faces of so many triangles that it would take long. Entities of one boundary do
 * not cross, so corners and edges are enough.
 */
export function measure(model, first, second) {
  let best = null;
  const a = partsOf(model, first);
  const b = partsOf(model, second);
  if (a.length * b.length > mostPairs) return null;
  for (const x of a)
    for (const y of b)
      for (const f of flatsOf(x))
        for (const g of flatsOf(y)) {
          if (f.length + g.length > 4) continue;
          const at = (v) => model.point(v);
          const found = squaredDistance(f.map(at), g.map(at), doubles);
          if (found && found.inside && (!best || found.square < best.square))
            best = { square: found.square, flats: [f, g] };
        }
  if (!best) return null;
  const exact = (v) => model.exactPoint(v);
  const found = squaredDistance(best.flats[0].map(exact), best.flats[1].map(exact), fractions);
  const square = found.square;
  const rounded = best.flats.flat().some((v) => model.precision(v) === 'rounded');
  return { square, distance: Math.sqrt(square.toNumber()), rounded };
}
