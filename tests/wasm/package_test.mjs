// SPDX-License-Identifier: Apache-2.0
//
// The package for JavaScript under node: its interface, and its results beside the native library's.
//
//     node package_test.mjs PACKAGE NATIVE_RESULTS MANIFEST [--cases 1000] [--seed 1]
//
// PACKAGE is the folder that scripts/build-wasm makes, MANIFEST its program of signs. Exits with 77 where
// they are not built.
//
// A file of cases has, for each: operation and number of operands; of each operand the counts of
// vertices and faces, the vertices, the faces; the count of points, and these; a pose. Results have, for
// each: counts, vertices, faces, sources; volume, area; the exact volume's length and text; one byte a
// point; the relation of the first two operands. Words have 32 bits, numbers 64.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

import { operations, Random, randomCase } from './random_cases.mjs';

const [folder, native, manifest, ...options] = process.argv.slice(2);
const option = (name, otherwise) => {
  const at = options.indexOf(name);
  return at < 0 ? otherwise : Number(options[at + 1]);
};
if (!existsSync(path.join(folder, 'trisect.wasm'))) {
  console.log('package_test: the package is not built: scripts/build-wasm');
  process.exit(77);
}
const trisect = await import(pathToFileURL(path.resolve(folder, 'trisect.js')));
const { Location, Motion, Pose, Scene, Solid, TrisectError } = trisect;

function throwsKind(kind, message, call) {
  assert.throws(call, (e) => e instanceof TrisectError && e.kind === kind && message.test(e.message));
}

function testBefore() {
  throwsKind('usage', /init\(\)/, () => Solid.box([0, 0, 0], [1, 1, 1]));
}

function testSolids() {
  const a = Solid.box([0, 0, 0], [4, 3, 1]);
  const b = Solid.cylinder(0.5, 2, 64).translate([2, 1.5, -0.5]);
  const part = a.difference(b);
  assert.equal(a.volume, 12);
  assert.equal(a.area, 38);
  assert.equal(a.exactVolume, '12');
  assert.ok(Math.abs(part.volume - (12 - 0.25 * Math.PI)) < 0.01);
  assert.deepEqual(part.bounds, { low: [0, 0, 0], high: [4, 3, 1] });
  assert.deepEqual(a.centroid, [2, 1.5, 0.5]);
  assert.deepEqual([...part.locate([2, 1.5, 0.5, 1, 1, 0.5, 1, 1, 0, 0, 0, 0, 0, 0, 0.5])],
    [Location.OUTSIDE, Location.INSIDE, Location.ON_FACE, Location.ON_VERTEX, Location.ON_EDGE]);
  assert.equal(part.firstHit([1, 1, 5], [0, 0, -2]).parameter, 2);
  assert.equal(part.firstHit([2, 1.5, 5], [0, 0, -2]), null);
  const distances = part.signedDistances([1, 1, 0.75, 1, 1, 1, 1, 1, 3]);
  [-0.25, 0, 2].forEach((d, i) => assert.ok(Math.abs(distances[i] - d) < 1e-10 && Math.sign(distances[i]) === Math.sign(d)));
  const loops = part.section([0, 0, 1, -0.5]);
  assert.deepEqual(loops.map((l) => [l.region, l.isHole]), [[0, false], [0, true]]);
  const { vertices, faces, sources } = part.mesh();
  assert.ok(sources.length === (2 * faces.length) / 3 && new Set(sources.filter((_, i) => i % 2 === 0)).size === 2);
  assert.ok(new Solid(vertices, faces).volume - part.volume < 1e-12);
  assert.ok(part.union(b.intersection(a)).equals(a));
  assert.ok(Solid.fromExactText(part.exactText).equals(part));
  assert.equal(trisect.union([a, b, a]).equals(a.union(b)), true);
  assert.equal(trisect.xor([a, a]).isEmpty, true);
  assert.equal(Solid.empty().complement().isWholeSpace, true);
  assert.equal(a.split([1, 0, 0, -1])[0].volume, 3);
  assert.equal(a.split(Solid.box([1, 0, 0], [2, 3, 1])).map((s) => s.volume).join(), '3,9');
  assert.equal(a.difference(Solid.box([1, 0, 0], [2, 3, 1])).components().length, 2);
  assert.deepEqual(a.rotate([0, 0, 1], 90).bounds, { low: [-3, 0, 0], high: [0, 4, 1] });
  assert.equal(a.scale([2, 1, 1]).volume, 24);
  assert.equal(Solid.fromCsg('difference() { cube(size = [2, 2, 2], center = false); cube(size = [1, 1, 1], center = false); }').volume, 7);
}

function testMotions() {
  const a = Solid.box([0, 0, 0], [1, 1, 1]);
  const relations = [[0, 'equal'], [0.5, 'overlapping'], [1, 'touching'], [1 + 2 ** -50, 'disjoint']];
  for (const [x, relation] of relations)
    assert.equal(trisect.interfere(a, null, a, Pose.translation([x, 0, 0])), relation);
  const away = Pose.translation([3, 0, 0]);
  const { lower, upper } = trisect.distance(a, null, a, away);
  assert.ok(lower <= 2 && 2 <= upper && upper - lower < 1e-9);
  assert.equal(trisect.areNearerThan(a, null, a, away, 2), false);
  assert.equal(trisect.firstContact(a, null, a, Motion.translation(away, [-4, 0, 0])), 0.5);
  assert.equal(trisect.firstContact(a, null, a, Motion.translation(away, [4, 0, 0])), null);
  assert.deepEqual(Pose.fromQuaternion([1, 0, 0, 1]).times(Pose.fromQuaternion([1, 0, 0, -1])).rows,
    [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]);
  const scene = new Scene();
  const bodies = [scene.add(a), scene.add(a, away)];
  assert.deepEqual(scene.interfering(), []);
  scene.setPose(bodies[1], Pose.translation([1, 1, 1]));
  assert.equal(scene.interfering()[0].relation, 'touching');
  scene.remove(bodies[1]);
  assert.deepEqual(scene.interfering(), []);
}

function testErrors() {
  const { vertices, faces } = Solid.box([0, 0, 0], [1, 1, 1]).mesh();
  throwsKind('invalid_solid', /open_edge/, () => new Solid(vertices, faces.slice(3)));
  throwsKind('usage', /99/, () => new Solid(vertices, [...faces.slice(3), 0, 1, 99]));
  throwsKind('usage', /triangles/, () => new Solid(vertices, [0, 1]));
  throwsKind('usage', /radius/, () => Solid.cylinder(-1, 1));
  throwsKind('input', /text/, () => Solid.fromCsg('cube(size = ['));
  throwsKind('unsupported', /./, () => Solid.halfSpace([0, 0, 1, 0]).mesh());
  const report = trisect.check(vertices, faces.slice(3));
  assert.equal(report.isSolid, false);
  assert.equal(report.findings[0].kind, 'open_edge');
  assert.equal(report.findings[0].place.length, 3);
  const box = { vertices, faces };
  assert.equal(trisect.verify('union', [box, box], box).verdict, 'equal');
  assert.equal(trisect.verify('xor', [box, box], box).verdict, 'different');
  trisect.setLimits({ maxWork: 10 });
  throwsKind('limit', /work/, () => Solid.sphere(1, 4).difference(Solid.sphere(1, 4).translate([0.5, 0, 0])).volume);
  trisect.setLimits();
  const gone = Solid.empty();
  gone.delete();
  gone.delete();
  throwsKind('usage', /deleted/, () => gone.volume);
}

/** A chain of cuts makes a deep tree; recursion ends with an answer or a refusal. */
function testDeepTrees() {
  let part = Solid.box([0, 0, 0], [2000, 1, 1]);
  for (let i = 0; i < 400; ++i) part = part.difference(Solid.box([4 * i + 1, 0, 0], [4 * i + 2, 0.5, 2]));
  assert.equal(part.volume, 2000 - 400 * 0.5);
}

class Writer {
  parts = [];
  words(...values) {
    this.add(Uint32Array.from(values));
  }
  add(array) {
    this.parts.push(Buffer.from(array.buffer, array.byteOffset, array.byteLength));
  }
  bytes() {
    return Buffer.concat(this.parts);
  }
}

function writeCase(out, { operation, operands, points, rows }) {
  out.words(operation, operands.length);
  for (const { vertices, faces } of operands) {
    out.words(vertices.length / 3, faces.length / 3);
    out.add(vertices);
    out.add(faces);
  }
  out.words(points.length / 3);
  out.add(points);
  out.add(rows);
}

function resultOf({ operation, operands, points, rows }) {
  const out = new Writer();
  const solids = operands.map(({ vertices, faces }) => new Solid(vertices, faces));
  const ids = solids.map((s) => s.sourceId);
  const result = solids[0][operations[operation]](...solids.slice(1));
  const { vertices, faces, sources } = result.mesh();
  for (let i = 0; i < sources.length; i += 2) sources[i] = ids.indexOf(sources[i]);
  out.words(vertices.length / 3, faces.length / 3);
  for (const array of [vertices, faces, sources]) out.add(array);
  out.add(Float64Array.of(result.volume, result.area));
  const text = new TextEncoder().encode(result.exactVolume);
  out.words(text.length);
  out.add(text);
  out.add(result.locate(points));
  const relation = trisect.interfere(solids[0], null, solids[1], new Pose(rows));
  out.words(['disjoint', 'touching', 'overlapping', 'inside', 'contains', 'equal'].indexOf(relation));
  for (const s of [...solids, result]) s.delete();
  return { bytes: out.bytes(), triangles: faces.length / 3 };
}

function testBytes(count, seed) {
  const random = new Random(seed);
  const cases = Array.from({ length: count }, () => randomCase(random));
  const scratch = mkdtempSync(path.join(tmpdir(), 'trisect-wasm-'));
  try {
    const out = new Writer();
    for (const c of cases) writeCase(out, c);
    writeFileSync(path.join(scratch, 'cases'), out.bytes());
    execFileSync(native, [path.join(scratch, 'cases'), path.join(scratch, 'results')], { stdio: 'inherit' });
    const expected = readFileSync(path.join(scratch, 'results'));
    let at = 0;
    let triangles = 0;
    let empty = 0;
    cases.forEach((c, i) => {
      const result = resultOf(c);
      const same = expected.subarray(at, at + result.bytes.length);
      assert.ok(same.equals(result.bytes), `case ${i} of seed ${seed}, ${operations[c.operation]}: bytes differ`);
      at += result.bytes.length;
      triangles += result.triangles;
      if (result.triangles === 0) ++empty;
    });
    assert.equal(at, expected.length);
    console.log(`${count} booleans byte-equal to native: ${triangles} triangles, ${at} bytes, ${empty} results empty`);
  } finally {
    rmSync(scratch, { recursive: true });
  }
}

async function testManifest() {
  const { instance } = await WebAssembly.instantiate(readFileSync(manifest), {
    env: { emscripten_notify_memory_growth() {} },
    wasi_snapshot_preview1: new Proxy({}, { get: () => () => 52, has: () => true }),
  });
  instance.exports._initialize?.();
  const hash = BigInt.asUintN(64, instance.exports.sign_manifest_hash());
  assert.equal(hash, 16618475444522659819n);
  console.log(`sign manifest ${hash}`);
}

testBefore();
// The first module alone, then all.
await trisect.init(undefined, { more: false });
{
  const box = Solid.box([0, 0, 0], [1, 1, 1]);
  assert.equal(box.union(box.translate([0.5, 0, 0])).volume, 1.5);
  assert.deepEqual([...box.locate([2, 0, 0])], [Location.OUTSIDE]);
  assert.equal(box.section([0, 0, 1, -0.5]).length, 1);
  throwsKind('usage', /trisect-more\.wasm/, () => trisect.interfere(box, null, box, null));
  throwsKind('usage', /trisect-more\.wasm/, () => Solid.fromCsg('cube(1);'));
  throwsKind('usage', /trisect-more\.wasm/, () => new Scene());
  throwsKind('usage', /trisect-more\.wasm/, () => Solid.halfSpace([0, 0, 1, 0]));
  throwsKind('usage', /trisect-more\.wasm/, () => box.exactText);
  throwsKind('usage', /trisect-more\.wasm/, () => box.split([0, 0, 1, -0.5]));
  await trisect.init();
  assert.equal(trisect.interfere(box, null, box, null), 'equal');
}
await Promise.all([trisect.init(), trisect.init()]);
console.log(`trisect ${trisect.version()} under node ${process.versions.node}`);
testSolids();
testMotions();
testErrors();
testDeepTrees();
testBytes(option('--cases', 1000), option('--seed', 1));
if (existsSync(manifest)) await testManifest();
else throw new Error(`${manifest} is missing`);
