// SPDX-License-Identifier: Apache-2.0
//
// Booleans of this project's package for JavaScript beside those of `manifold-3d`, in one node.
//
//     node wasm_beside_manifold.mjs PACKAGE MANIFOLD [--rounds 5] [--runs 5]
//
// From arrays of triangles to arrays of triangles; both take turns, and a row has the medians over the
// rounds of the medians over the runs. Manifold's arrays hold floats, so coordinates are rounded to 24 bits
// for it. PACKAGE is what scripts/build-wasm makes, MANIFOLD the unpacked npm package; scripts/bench-wasm
// fetches it.

import { readFileSync } from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

const [folder, other, ...options] = process.argv.slice(2);
const option = (name, otherwise) => {
  const at = options.indexOf(name);
  return at < 0 ? otherwise : Number(options[at + 1]);
};
const trisect = await import(pathToFileURL(path.resolve(folder, 'trisect.js')));
await trisect.init();
const manifold = await (await import(pathToFileURL(path.resolve(other, 'manifold.js')))).default();
manifold.setup();
const { Manifold, Mesh } = manifold;

function ball(rows, columns, [x, y, z], r) {
  const vertices = [x, y, z - r];
  const faces = [];
  for (let i = 1; i < rows; ++i)
    for (let k = 0; k < columns; ++k) {
      const [a, b] = [Math.PI * (i / rows - 0.5), (2 * Math.PI * k) / columns];
      vertices.push(x + r * Math.cos(a) * Math.cos(b), y + r * Math.cos(a) * Math.sin(b), z + r * Math.sin(a));
    }
  const top = vertices.length / 3;
  vertices.push(x, y, z + r);
  const at = (i, k) => 1 + (i - 1) * columns + (k % columns);
  for (let k = 0; k < columns; ++k) {
    faces.push(0, at(1, k + 1), at(1, k), top, at(rows - 1, k), at(rows - 1, k + 1));
    for (let i = 1; i < rows - 1; ++i)
      faces.push(at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i, k), at(i + 1, k + 1), at(i + 1, k));
  }
  return { vertices: Float64Array.from(vertices), faces: Uint32Array.from(faces) };
}
function box(low, high) {
  const vertices = Array.from({ length: 8 }, (_, i) => [0, 1, 2].map((k) => ((i >> k) & 1 ? high : low)[k])).flat();
  const faces = [0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5];
  return { vertices: Float64Array.from(vertices), faces: Uint32Array.from(faces) };
}
function drills(count) {
  return Array.from({ length: count * count }, (_, i) => {
    const [x, y] = [(i % count) + 0.5, Math.floor(i / count) + 0.5];
    return ball(12, 24, [x, y, 0.5], 0.4);
  });
}
const balls = (rows, columns) => [ball(rows, columns, [0, 0, 0], 1), ball(rows, columns, [0.51, 0.32, 0.17], 1)];
const scenes = [
  ['two boxes', 'union', [box([0, 0, 0], [2, 2, 2]), box([1, 1, 1], [3, 3, 3])]],
  ['two balls', 'union', balls(16, 32)],
  ['two balls', 'difference', balls(50, 100)],
  ['two balls', 'union', balls(158, 316)],
  ['plate and 100 balls', 'difference', [box([0, 0, 0], [10, 10, 0.7]), ...drills(10)]],
];

function byTrisect(operation, meshes) {
  const solids = meshes.map(({ vertices, faces }) => new trisect.Solid(vertices, faces));
  const result = solids[0][operation](...solids.slice(1));
  const mesh = result.mesh();
  for (const s of [...solids, result]) s.delete();
  return mesh.faces.length / 3;
}
function byManifold(operation, meshes) {
  const solids = meshes.map(({ vertices, faces }) =>
    new Manifold(new Mesh({ numProp: 3, vertProperties: Float32Array.from(vertices), triVerts: faces })));
  const result = Manifold[operation](solids);
  const mesh = result.getMesh();
  for (const s of [...solids, result]) s.delete();
  return mesh.triVerts.length / 3;
}

const median = (list) => [...list].sort((a, b) => a - b)[Math.floor(list.length / 2)];
function time(call, runs) {
  const times = [];
  for (let i = 0; i < runs; ++i) {
    const start = performance.now();
    call();
    times.push(performance.now() - start);
  }
  return median(times);
}

const version = JSON.parse(readFileSync(path.join(other, 'package.json'))).version;
console.log(`node ${process.versions.node}, manifold-3d ${version}`);
console.log('| scene | operation | triangles in | out | Manifold: out | trisect, ms | manifold-3d, ms | ratio |');
console.log('|---|---|---:|---:|---:|---:|---:|---:|');
for (const [name, operation, meshes] of scenes) {
  const input = meshes.reduce((sum, m) => sum + m.faces.length / 3, 0);
  const [out, theirs] = [byTrisect(operation, meshes), byManifold(operation, meshes)];
  const rounds = Array.from({ length: option('--rounds', 5) }, () => {
    const runs = input < 1000 ? 20 * option('--runs', 5) : option('--runs', 5);
    return [time(() => byTrisect(operation, meshes), runs), time(() => byManifold(operation, meshes), runs)];
  });
  const [ours, others] = [0, 1].map((i) => median(rounds.map((r) => r[i])));
  const ratio = median(rounds.map((r) => r[0] / r[1]));
  console.log(`| ${name} | ${operation} | ${input} | ${out} | ${theirs} | ${ours.toFixed(2)} | ${others.toFixed(2)} | ${ratio.toFixed(2)} |`);
}
