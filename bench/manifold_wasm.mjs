// SPDX-License-Identifier: Apache-2.0
//
// The engine that Manifold's npm package `manifold-3d` is, a WebAssembly build: for machines without
// the native library. Its arrays hold floats, so coordinates are rounded to 24 bits on the way in,
// and volumes agree to about 1e-6 only.
//
//     bench_trisect --scene NAME --op OPERATION --dump FILE
//     node manifold_wasm.mjs FILE [--runs 5] [--limit SECONDS] [--serve]
//
// Says what bench/run_engine.cpp says. MANIFOLD_WASM names the folder of the package when node does
// not find it by itself.

import fs from 'node:fs';
import path from 'node:path';
import {performance} from 'node:perf_hooks';
import readline from 'node:readline';
import {pathToFileURL} from 'node:url';

const folder = process.env.MANIFOLD_WASM;
const module = folder ? pathToFileURL(path.join(folder, 'manifold.js')).href : 'manifold-3d';
const version = folder ? JSON.parse(fs.readFileSync(path.join(folder, 'package.json'))).version : '';
const wasm = await (await import(module)).default();
wasm.setup();
const {Manifold, Mesh} = wasm;

function readScene(file) {
    const data = fs.readFileSync(file);
    const end = data.indexOf('\n');
    const scene = JSON.parse(data.subarray(0, end));
    let at = end + 1;
    const take = (bytes) => {
        const copy = Uint8Array.prototype.slice.call(data, at, at + bytes).buffer;
        at += bytes;
        return copy;
    };
    scene.meshes = scene.sizes.map(([points, triangles]) => ({
        vertProperties: new Float32Array(new Float64Array(take(24 * points))),
        triVerts: new Uint32Array(take(12 * triangles)),
    }));
    return scene;
}

function imported({vertProperties, triVerts}) {
    const solid = new Manifold(new Mesh({numProp: 3, vertProperties, triVerts}));
    if (solid.status() !== 'NoError') throw new Error(`status ${solid.status()}`);
    return solid;
}

const operations = {
    union: (a, b) => Manifold.union(a, b),
    intersection: (a, b) => Manifold.intersection(a, b),
    difference: (a, b) => Manifold.difference(a, b),
};

/** Evaluation is lazy: asking for a count forces it. */
function combined(operation, a, b) {
    const result = operations[operation](a, b);
    result.numTri();
    return result;
}

function united(solids) {
    return solids.length === 1 ? solids[0] : Manifold.union(solids);
}

function runExpression(scene, times) {
    let start = performance.now();
    const solids = scene.meshes.map(imported);
    times.import_ms = performance.now() - start;
    start = performance.now();
    const first = united(solids.slice(0, scene.first_group));
    const second = solids.slice(scene.first_group);
    const result = second.length ? combined(scene.operation, first, united(second)) : first;
    result.numTri();
    times.evaluate_ms = performance.now() - start;
    return {result, garbage: solids};
}

function runChain(scene, times, limit) {
    const begin = performance.now();
    let start = performance.now();
    let part = imported(scene.meshes[0]);
    times.import_ms = scene.untimed ? 0 : performance.now() - start;
    times.evaluate_ms = 0;
    let steps = 0;
    for (; steps < scene.steps.length; ++steps) {
        if (limit && scene.steps.length >= 100 && performance.now() - begin > 1000 * limit) break;
        start = performance.now();
        const tool = imported(scene.meshes[1 + steps]);
        const between = performance.now();
        const next = combined(scene.steps[steps], part, tool);
        if (steps >= scene.untimed) {
            times.import_ms += between - start;
            times.evaluate_ms += performance.now() - between;
        }
        part.delete();
        tool.delete();
        part = next;
    }
    scene.done = steps;
    times.steps = steps - scene.untimed;
    return {result: part, garbage: []};
}

const args = process.argv.slice(2);
const option = (name, otherwise) =>
    args.includes(name) ? args[args.indexOf(name) + 1] : otherwise;
const scene = readScene(args[0]);
const runs = [];
let last = null;

function run() {
    const times = {steps: 1};
    const limit = Number(option('--limit', 0));
    const {result, garbage} =
        scene.steps.length ? runChain(scene, times, limit) : runExpression(scene, times);
    const start = performance.now();
    const mesh = result.getMesh();
    times.export_ms = performance.now() - start;
    times.total_ms = times.import_ms + times.evaluate_ms + times.export_ms;
    last = {volume: result.volume(), vertices: result.numVert(), triangles: mesh.numTri};
    for (const solid of new Set([result, ...garbage])) solid.delete();
    runs.push(times);
    return times;
}

function median(values) {
    const sorted = [...values].sort((a, b) => a - b);
    const n = sorted.length;
    return n ? 0.5 * (sorted[(n - 1) >> 1] + sorted[n >> 1]) : 0;
}

function summary() {
    const out = {
        scene: scene.scene,
        operation: scene.operation,
        engine: 'manifold-wasm',
        version,
        threads: 1,
        runs: runs.length,
        open_edges: 0,
        peak_mb: process.resourceUsage().maxRSS / 1024,
        ...last,
    };
    for (const key of ['import_ms', 'evaluate_ms', 'export_ms', 'total_ms'])
        out[key] = median(runs.map((times) => times[key]));
    if (scene.steps.length)
        out.chain = {
            steps: scene.done,
            of: scene.steps.length,
            untimed: scene.untimed,
            window: 0,
            step_ms: [],
            resident_mb: [],
        };
    return out;
}

const say = (value) => fs.writeSync(1, JSON.stringify(value) + '\n');
try {
    if (args.includes('--serve')) {
        say({ready: true});
        for await (const _ of readline.createInterface({input: process.stdin})) say(run());
    } else {
        for (let i = 0; i < Number(option('--runs', 5)); ++i) run();
    }
    say(summary());
} catch (error) {
    say({scene: scene.scene, error: String(error.message ?? error)});
    process.exitCode = 1;
}
