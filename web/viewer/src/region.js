// SPDX-License-Identifier: Apache-2.0
//
// Convex regions of space, of a plane and of a line, cut by planes; in doubles, for pictures.
// A region of dimension 3 is a list of polygons around it, one of less a list of one "polygon":
// corners in a plane, the two ends of a segment, a point.

export function boxRegion(low, high) {
  const corner = (c) => [0, 1, 2].map((k) => ((c >> k) & 1 ? high[k] : low[k]));
  const faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
  return { dimension: 3, polygons: faces.map((f) => f.map(corner)) };
}

const value = (plane, p) =>
  plane.normal[0] * p[0] + plane.normal[1] * p[1] + plane.normal[2] * p[2] - plane.offset;

const between = (p, q, vp, vq) => {
  const t = vp / (vp - vq);
  return p.map((x, k) => x + t * (q[k] - x));
};

// The part on a side of the plane; what lies in the plane belongs to both.
function clipPolygon(points, plane, side) {
  const values = points.map((p) => side * value(plane, p));
  if (points.length === 1) return values[0] >= 0 ? points : [];
  const out = [];
  points.forEach((p, i) => {
    const j = (i + 1) % points.length;
    if (values[i] >= 0) out.push(p);
    if (points.length === 2 && i === 1) return;
    if (values[i] * values[j] < 0) out.push(between(p, points[j], values[i], values[j]));
  });
  return out;
}

/** Where a plane cuts a region: a polygon, a segment or a point; empty where it does not. */
export function cutOf(region, plane) {
  const found = [];
  for (const polygon of region.polygons)
    polygon.forEach((p, i) => {
      if (polygon.length === 2 && i === 1) return;
      const q = polygon[(i + 1) % polygon.length];
      const [vp, vq] = [value(plane, p), value(plane, q)];
      if (vp * vq < 0) found.push(between(p, q, vp, vq));
      else if (vp === 0) found.push(p);
      else if (vq === 0 && polygon.length === 2) found.push(q);
    });
  const points = [];
  const scale = Math.max(1e-300, ...found.flat().map(Math.abs));
  for (const p of found)
    if (!points.some((q) => Math.hypot(...p.map((x, k) => x - q[k])) <= 1e-11 * scale))
      points.push(p);
  if (region.dimension < 3 || points.length < 3) return points;
  return inOrder(points, plane.normal);
}

// Corners of a convex polygon by their angles about its middle.
function inOrder(points, normal) {
  const middle = [0, 1, 2].map((k) => points.reduce((s, p) => s + p[k], 0) / points.length);
  const n = normal.map(Math.abs);
  const axis = n.indexOf(Math.max(...n));
  const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
  return points
    .map((p) => ({ p, angle: Math.atan2(p[v] - middle[v], p[u] - middle[u]) }))
    .sort((a, b) => a.angle - b.angle)
    .map((x) => x.p);
}

/** The part of a region below (-1), on (0) or above (1) a plane. */
export function partOf(region, plane, side) {
  const cut = side === 0 || region.dimension === 3 ? cutOf(region, plane) : [];
  if (side === 0) return { dimension: region.dimension - 1, polygons: cut.length ? [cut] : [] };
  const polygons = region.polygons
    .map((p) => clipPolygon(p, plane, side))
    .filter((p) => p.length >= Math.min(3, region.dimension));
  if (region.dimension === 3 && cut.length >= 3) polygons.push(cut);
  return { dimension: region.dimension, polygons };
}

/** Ends of all edges of polygons, as numbers. */
export function endsOf(polygons) {
  const out = [];
  for (const polygon of polygons)
    polygon.forEach((p, i) => {
      if (polygon.length === 1 || (polygon.length === 2 && i === 1)) return;
      out.push(p, polygon[(i + 1) % polygon.length]);
    });
  return out;
}

/** Corners of triangles of convex polygons. */
export function trianglesOf(polygons) {
  const out = [];
  for (const p of polygons)
    for (let k = 1; k + 1 < p.length; ++k) out.push(p[0], p[k], p[k + 1]);
  return out;
}
