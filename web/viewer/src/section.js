// SPDX-License-Identifier: Apache-2.0
//
// Loops in which a plane across an axis cuts the boundary. Which edges it pierces, and in what
// order, is exact; what lies in the plane counts as above it.

/** Loops as lists of points; each point is where an edge is pierced. */
export function sectionLoops(model, axis, at) {
  const isAbove = new Uint8Array(model.vertexCount);
  for (let v = 0; v < model.vertexCount; ++v) isAbove[v] = model.side(v, axis, at) >= 0 ? 1 : 0;
  // In each triangle a segment from the edge that goes up to the edge that goes down.
  const next = new Map();
  for (let t = 0; t < model.triangleCount; ++t) {
    let from = null;
    let to = null;
    for (let k = 0; k < 3; ++k) {
      const a = model.triangles[3 * t + k];
      const b = model.triangles[3 * t + ((k + 1) % 3)];
      if (isAbove[a] === isAbove[b]) continue;
      if (isAbove[b]) from = [a, b];
      else to = [b, a];
    }
    if (!from) continue;
    const key = model.keyOf(...from);
    if (!next.has(key)) next.set(key, []);
    next.get(key).push({ from, to: model.keyOf(...to), triangle: t });
  }
  const loops = [];
  for (const list of next.values())
    while (list.length) loops.push(walk(model, next, list, axis, at));
  return loops.filter((l) => l.length > 2);
}

function walk(model, next, list, axis, at) {
  const loop = [];
  let step = list.pop();
  while (step) {
    const [low, high] = step.from;
    // Diagonals of faces are no edges.
    if (model.edgeBetween(low, high) !== undefined) loop.push(pierced(model, low, high, axis, at));
    const following = next.get(step.to);
    step = following && following.length ? following.pop() : null;
  }
  return loop;
}

function pierced(model, low, high, axis, at) {
  const a = model.point(low);
  const b = model.point(high);
  const way = b[axis] - a[axis];
  const t = way === 0 ? 0 : Math.min(1, Math.max(0, (at - a[axis]) / way));
  const p = a.map((x, k) => x + t * (b[k] - x));
  p[axis] = at;
  return p;
}

/** The area that loops enclose, holes taken off. */
export function areaOf(loops, axis) {
  const u = (axis + 1) % 3;
  const v = (axis + 2) % 3;
  let sum = 0;
  for (const loop of loops)
    for (let i = 0; i < loop.length; ++i) {
      const p = loop[i];
      const q = loop[(i + 1) % loop.length];
      sum += p[u] * q[v] - p[v] * q[u];
    }
  return Math.abs(sum) / 2;
}
