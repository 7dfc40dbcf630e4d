// SPDX-License-Identifier: Apache-2.0
//
// Bodies under poses, with findings at their places.

import * as THREE from 'three';
import { acceleratedRaycast } from 'three-mesh-bvh';

import { Picture, darkness, manyEdges, mark, palette, toSegment } from './picture.js';
import { Shape } from './shape.js';

const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];
const looks = {
  solid: { opacity: 1, edges: 0.55 },
  clear: { opacity: 0.25, edges: 0.3 },
  faint: { opacity: 0.06, edges: 0.06 },
};
// Dark and light, so that they differ without colour, too; the chosen one is thick.
export const kindColors = { error: '#b3003c', warning: '#7d5300', note: '#00508f' };
const kindColorsInDark = { error: '#ff7aa2', warning: '#ffd27a', note: '#8fd0ff' };
export const colorOfKind = (kind) => (darkness.matches ? kindColorsInDark : kindColors)[kind];

export const placed = (pose, p) =>
  [0, 1, 2].map(
    (i) => pose[4 * i] * p[0] + pose[4 * i + 1] * p[1] + pose[4 * i + 2] * p[2] + pose[4 * i + 3],
  );

/** Bounds of everything that a page shows, at all times. */
function boundsOf(facts, shapes, poses) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  const add = (shape, pose) => {
    for (let c = 0; c < 8; ++c) {
      const corner = [0, 1, 2].map((k) => ((c >> k) & 1 ? shape.high[k] : shape.low[k]));
      placed(pose, corner).forEach((x, k) => {
        low[k] = Math.min(low[k], x);
        high[k] = Math.max(high[k], x);
      });
    }
  };
  const moving = facts.timeline?.bodies ?? [];
  facts.bodies.forEach((body, b) => {
    const shape = shapes[body.shape];
    if (shape.isEmpty) return;
    const m = moving.indexOf(b);
    if (m < 0) return add(shape, body.pose ?? identity);
    const count = facts.timeline.times.length;
    for (let f = 0; f < count; f += Math.max(1, count >> 5)) add(shape, poses(f, m));
    add(shape, poses(count - 1, m));
  });
  if (low[0] > high[0]) return { middle: [0, 0, 0], size: 1 };
  return {
    middle: low.map((l, k) => (l + high[k]) / 2),
    size: Math.hypot(...high.map((h, k) => h - low[k])) || 1,
  };
}

export class Stage extends Picture {
  constructor(canvas, facts, arrays) {
    const shapes = Array.from({ length: facts.shapes }, (_, i) => new Shape(arrays, i));
    const moving = facts.timeline?.bodies.length ?? 0;
    const all = moving ? arrays.doubles('poses') : [];
    const poseOf = (frame, m) => all.subarray(12 * (frame * moving + m), 12 * (frame * moving + m + 1));
    const { middle, size } = boundsOf(facts, shapes, poseOf);
    super(canvas, middle, size);
    this.facts = facts;
    this.shapes = shapes;
    this.poseOf = poseOf;
    this.frame = 0;
    this.bodies = facts.bodies.map((body) => this.addBody(body));
    if (facts.timeline) this.setFrame(0);
    const edges = shapes.reduce((sum, s) => sum + s.edges.length / 2, 0);
    if (edges > manyEdges) this.details = this.bodies.map((body) => body.edges);
    this.addMarks();
    this.lookFrom([1, -1.3, 0.9]);
  }

  // --- Bodies ---

  addBody(facts) {
    const shape = this.shapes[facts.shape];
    const material = new THREE.MeshLambertMaterial({
      color: palette[facts.color % palette.length],
      flatShading: true,
      side: THREE.DoubleSide,
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
    });
    const mesh = new THREE.Mesh(shape.geometry, material);
    mesh.raycast = acceleratedRaycast;
    const edges = new THREE.LineSegments(
      shape.lines,
      new THREE.LineBasicMaterial({ color: '#1d2733', transparent: true }),
    );
    edges.raycast = () => {};
    const group = new THREE.Group();
    group.add(mesh, edges);
    group.matrixAutoUpdate = false;
    this.scene.add(group);
    const body = { facts, shape, mesh, edges, group, look: facts.look, name: facts.name };
    this.setPose(body, facts.pose ?? identity);
    this.setLook(body, facts.look);
    return body;
  }

  setPose(body, pose) {
    body.pose = pose;
    const t = this.local(placed(pose, body.shape.middle));
    body.group.matrix.set(
      pose[0], pose[1], pose[2], t[0],
      pose[4], pose[5], pose[6], t[1],
      pose[8], pose[9], pose[10], t[2],
      0, 0, 0, 1,
    );
    body.group.matrixWorldNeedsUpdate = true;
    body.group.updateMatrixWorld(true);
  }

  /** 'solid', 'clear', 'faint' or 'hidden'. */
  setLook(body, look) {
    body.look = look;
    body.group.visible = look !== 'hidden';
    const values = looks[look];
    if (values) {
      const through = values.opacity < 1;
      body.mesh.material.transparent = through;
      body.mesh.material.opacity = values.opacity;
      body.mesh.material.depthWrite = !through;
      body.mesh.material.needsUpdate = true;
      body.mesh.renderOrder = through ? 3 : 0;
      body.edges.material.opacity = values.edges;
      body.edges.renderOrder = through ? 4 : 1;
    }
    this.draw();
  }
  showEdges(on) {
    for (const body of this.bodies) body.edges.visible = on;
    this.draw();
  }

  setFrame(frame) {
    this.frame = frame;
    this.facts.timeline.bodies.forEach((b, m) => this.setPose(this.bodies[b], this.poseOf(frame, m)));
    this.draw();
  }

  // --- Findings ---

  addMarks() {
    this.dots = new THREE.Group();
    this.scene.add(this.dots);
    this.halo = this.addLine('#ffffff', 9);
    this.chosen = this.addLine(mark, 5);
    this.chosen.renderOrder = 7;
    this.halo.renderOrder = 6;
    this.hovered = this.addLine(mark, 4, this.over.scene);
    this.markedFaces = [];
    this.facesOfFinding = [];
    this.chosenDots = this.addDots(mark, 17, 8);
    this.haloDots = this.addDots('#ffffff', 23, 7);
  }

  addDots(color, size, order, scene = this.scene) {
    const out = new THREE.Points(
      new THREE.BufferGeometry(),
      new THREE.PointsMaterial({
        color, size, sizeAttenuation: false, depthTest: false, map: disc(), alphaTest: 0.5,
        transparent: true,
      }),
    );
    out.visible = false;
    out.frustumCulled = false;
    out.renderOrder = order;
    out.raycast = () => {};
    scene.add(out);
    return out;
  }
  setDots(dots, points) {
    dots.visible = points.length > 0;
    dots.geometry.dispose();
    dots.geometry = new THREE.BufferGeometry().setAttribute(
      'position',
      new THREE.Float32BufferAttribute(points.flatMap((p) => this.local(p)), 3),
    );
  }

  /** All findings that are there at this moment, thin. */
  showFindings(findings) {
    if (!this.kindMarks) {
      this.kindMarks = {};
      for (const kind of ['error', 'warning', 'note'])
        this.kindMarks[kind] = {
          line: this.addLine(colorOfKind(kind), 3),
          dots: this.addDots(colorOfKind(kind), 11, 5),
          areas: this.addAreas(colorOfKind(kind)),
        };
    }
    for (const [kind, marks] of Object.entries(this.kindMarks)) {
      const here = findings.filter((f) => f.kind === kind);
      this.setLine(marks.line, here.flatMap((f) => this.endsOf(f)));
      this.setDots(marks.dots, here.flatMap((f) => f.points ?? []));
      this.setAreas(marks.areas, here.flatMap((f) => (f.loops ? [f.loops] : [])));
    }
    this.draw();
  }

  endsOf(finding) {
    const out = [];
    for (const [a, b] of finding.segments ?? []) out.push(...this.local(a), ...this.local(b));
    for (const loop of finding.loops ?? [])
      loop.forEach((p, i) =>
        out.push(...this.local(p), ...this.local(loop[(i + 1) % loop.length])),
      );
    return out;
  }

  addAreas(color) {
    const out = new THREE.Mesh(
      new THREE.BufferGeometry(),
      new THREE.MeshBasicMaterial({
        color, transparent: true, opacity: 0.45, side: THREE.DoubleSide, depthWrite: false,
        depthTest: false,
      }),
    );
    out.visible = false;
    out.frustumCulled = false;
    out.renderOrder = 4;
    out.raycast = () => {};
    this.scene.add(out);
    return out;
  }
  setAreas(mesh, areas) {
    const corners = areas.flatMap((loops) => trianglesOfArea(loops).flatMap((p) => this.local(p)));
    mesh.visible = corners.length > 0;
    mesh.geometry.dispose();
    mesh.geometry = new THREE.BufferGeometry().setAttribute(
      'position',
      new THREE.Float32BufferAttribute(corners, 3),
    );
  }

  /** Marks one finding, or none. */
  choose(finding) {
    const ends = finding ? this.endsOf(finding) : [];
    this.setLine(this.halo, ends);
    this.setLine(this.chosen, ends);
    const points = finding?.points ?? [];
    this.setDots(this.haloDots, points);
    this.setDots(this.chosenDots, points);
    for (const m of this.facesOfFinding) m.parent.remove(m);
    this.facesOfFinding = (finding?.faces ?? []).map(([b, face]) => this.faceMark(b, face, 0.5));
    this.draw();
  }

  faceMark(b, face, opacity, parent = this.bodies[b].group) {
    const body = this.bodies[b];
    const mesh = new THREE.Mesh(
      new THREE.BufferGeometry().setAttribute(
        'position',
        new THREE.BufferAttribute(body.shape.positionsOfFace(face), 3),
      ),
      new THREE.MeshBasicMaterial({
        color: mark, transparent: true, opacity, side: THREE.DoubleSide, depthWrite: false,
      }),
    );
    mesh.raycast = () => {};
    mesh.renderOrder = 4;
    mesh.matrixWorldAutoUpdate = false;
    mesh.matrixWorld = body.group.matrixWorld; // moves with the body
    parent.add(mesh);
    return mesh;
  }

  /** What a finding is about: a middle and how far it reaches. */
  placeOf(finding) {
    const all = [
      ...(finding.points ?? []),
      ...(finding.segments ?? []).flat(),
      ...(finding.loops ?? []).flat(),
    ];
    if (!all.length)
      for (const [b, face] of finding.faces ?? []) {
        const { shape, pose } = this.bodies[b];
        const [first, end] = shape.trianglesOf(face);
        for (let i = 3 * first; i < 3 * end; ++i)
          all.push(placed(pose, shape.point(shape.triangles[i])));
      }
    if (!all.length) return null;
    const low = [0, 1, 2].map((k) => Math.min(...all.map((p) => p[k])));
    const high = [0, 1, 2].map((k) => Math.max(...all.map((p) => p[k])));
    return {
      place: low.map((l, k) => (l + high[k]) / 2),
      reach: Math.hypot(...high.map((h, k) => h - low[k])),
    };
  }

  // --- Picks ---

  /** The vertex, edge or face of a body at a pixel. What is seen through is there where nothing else is. */
  pick(x, y, reach = 6) {
    const raycaster = this.rayAt(x, y);
    const hitOf = (wanted) => {
      let best = null;
      for (const body of this.bodies) {
        if (!wanted(body)) continue;
        for (const h of raycaster.intersectObject(body.mesh, false))
          if (!best || h.distance < best.distance) best = { ...h, body };
      }
      return best;
    };
    const hit = hitOf((b) => b.look === 'solid') ?? hitOf((b) => b.look === 'clear');
    if (!hit) return null;
    const { body } = hit;
    const { shape } = body;
    const face = shape.faces[hit.faceIndex];
    const corners = [0, 1, 2].map((k) => shape.triangles[3 * hit.faceIndex + k]);
    const at = corners.map((v) => this.pixelOf(this.local(placed(body.pose, shape.point(v)))));
    const item = {
      body: this.bodies.indexOf(body), face, triangle: hit.faceIndex,
      point: hit.point.toArray().map((c, k) => c + this.middle[k]),
    };
    for (let k = 0; k < 3; ++k)
      if (Math.hypot(at[k][0] - x, at[k][1] - y) <= reach)
        return { kind: 'vertex', number: corners[k], ...item };
    for (let k = 0; k < 3; ++k) {
      const edge = shape.edgeBetween(corners[k], corners[(k + 1) % 3]);
      if (edge !== undefined && toSegment([x, y], at[k], at[(k + 1) % 3]) <= reach / 2)
        return { kind: 'edge', number: edge, ...item };
    }
    return { kind: 'face', number: face, ...item };
  }

  /** Marks what the mouse is at. */
  highlight(item) {
    for (const m of this.markedFaces) m.parent.remove(m);
    this.markedFaces = [];
    this.setLine(this.hovered, []);
    if (item) {
      const { shape, pose } = this.bodies[item.body];
      const ends =
        item.kind === 'edge' ? [shape.edges[2 * item.number], shape.edges[2 * item.number + 1]] : [];
      this.setLine(this.hovered, ends.flatMap((v) => this.local(placed(pose, shape.point(v)))));
      if (item.kind !== 'edge')
        this.markedFaces = [this.faceMark(item.body, item.face, 0.3, this.over.scene)];
      if (!this.hoveredDot) this.hoveredDot = this.addDots(mark, 11, 8, this.over.scene);
      this.setDots(
        this.hoveredDot,
        item.kind === 'vertex' ? [placed(pose, shape.point(item.number))] : [],
      );
    } else if (this.hoveredDot) {
      this.setDots(this.hoveredDot, []);
    }
    this.drawOver();
  }
}

let discTexture;
function disc() {
  if (discTexture) return discTexture;
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = 32;
  const context = canvas.getContext('2d');
  context.fillStyle = '#fff';
  context.beginPath();
  context.arc(16, 16, 15, 0, 2 * Math.PI);
  context.fill();
  discTexture = new THREE.CanvasTexture(canvas);
  return discTexture;
}

// Corners of triangles of a plane area; the largest loop is its outline, the others are holes.
function trianglesOfArea(loops) {
  const normal = (loop) => {
    const n = [0, 0, 0];
    loop.forEach((p, i) => {
      const q = loop[(i + 1) % loop.length];
      for (let k = 0; k < 3; ++k) {
        const [u, v] = [(k + 1) % 3, (k + 2) % 3];
        n[k] += (p[u] - loop[0][u]) * (q[v] - loop[0][v]) - (p[v] - loop[0][v]) * (q[u] - loop[0][u]);
      }
    });
    return n;
  };
  const sorted = loops
    .map((loop) => ({ loop, normal: normal(loop) }))
    .sort((a, b) => Math.hypot(...b.normal) - Math.hypot(...a.normal));
  if (!sorted.length) return [];
  const n = sorted[0].normal.map(Math.abs);
  const axis = n.indexOf(Math.max(...n));
  const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
  const flat = sorted.map((s) => s.loop.map((p) => new THREE.Vector2(p[u], p[v])));
  const all = sorted.flatMap((s) => s.loop);
  return THREE.ShapeUtils.triangulateShape(flat[0], flat.slice(1)).flat().map((i) => all[i]);
}
