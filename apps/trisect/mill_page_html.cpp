// SPDX-License-Identifier: Apache-2.0
//
// The viewer: WebGL 1 without libraries. All triangles of all frames are in one buffer, each with
// the frames of its life; the vertex program puts those that do not live away. A frame costs one
// call, and going from one to another nothing.
#include "mill_page.h"

namespace trisect::app {

const char* const mill_page_before_facts = R"html(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<title>Milled stock</title>
<style>
:root { color-scheme: light dark; --back: #eef1f5; --panel: #fff; --ink: #1d2733; --line: #cfd6df; }
@media (prefers-color-scheme: dark) {
  :root { --back: #20262e; --panel: #2b333d; --ink: #e8edf3; --line: #46505c; }
}
html, body { margin: 0; height: 100%; overflow: hidden; background: var(--back); color: var(--ink);
  font: 14px/1.4 system-ui, sans-serif; }
#view { position: absolute; inset: 0 0 118px 0; width: 100%; height: calc(100% - 118px);
  display: block; cursor: grab; touch-action: none; }
#panel { position: absolute; left: 0; right: 0; bottom: 0; height: 118px; background: var(--panel);
  border-top: 1px solid var(--line); padding: 6px 12px; box-sizing: border-box; }
#graph { width: 100%; height: 34px; display: block; }
#slider { width: 100%; margin: 0; }
#row { display: flex; gap: 14px; align-items: center; white-space: nowrap; }
#facts { flex: 1; overflow: hidden; text-overflow: ellipsis; font-variant-numeric: tabular-nums; }
#list { position: absolute; top: 10px; right: 10px; max-width: 46ch; max-height: 60%;
  overflow: auto; }
#list div { background: var(--panel); border-left: 4px solid #d22; margin-bottom: 6px; padding: 6px 10px;
  cursor: pointer; box-shadow: 0 1px 3px #0003; white-space: pre-wrap; }
#list div.none { border-color: #2a2; cursor: default; }
#busy { position: absolute; top: 40%; width: 100%; text-align: center; }
button { min-width: 5.5em; }
</style>
</head>
<body>
<canvas id="view" tabindex="0" role="img" aria-label="the stock; arrow keys turn it"></canvas>
<div id="list"></div>
<div id="busy">unpacking</div>
<div id="panel">
<canvas id="graph"></canvas>
<input id="slider" type="range" min="0" value="0" step="1" aria-label="step">
<div id="row">
<button id="play">play</button>
<span id="facts"></span>
<label><input type="checkbox" id="show_tool" checked> tool and holder</label>
<label><input type="checkbox" id="show_fixtures" checked> fixtures</label>
<label><input type="checkbox" id="show_path" checked> path</label>
</div>
</div>
<script>
"use strict";
const facts = )html";

const char* const mill_page_before_data = R"html(;
const packed = ")html";

const char* const mill_page_end = R"html(";

const by_id = (id) => document.getElementById(id);

async function unpacked() {
  const text = atob(packed);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}
const bytes_of = (data, name) => new Uint8Array(data, facts.places[name][0], facts.places[name][1]);
const floats_of = (data, name) =>
  new Float32Array(data, facts.places[name][0], facts.places[name][1] / 4);

function integers(bytes, count) {
  const out = new Int32Array(count);
  let last = 0;
  for (let i = 0, at = 0; i < count; ++i) {
    let n = 0, factor = 1, byte;
    do { byte = bytes[at++]; n += (byte & 127) * factor; factor *= 128; } while (byte & 128);
    last += n % 2 ? -(n + 1) / 2 : n / 2;
    out[i] = last;
  }
  return out;
}

// Three corners a triangle with its normal; `life` has its frames and its kind.
function stock_arrays(data) {
  const axes = ["x", "y", "z"].map((n) => integers(bytes_of(data, n), facts.points));
  const corners = integers(bytes_of(data, "corners"), 3 * facts.triangles);
  const [births, deaths, cuts] = ["births", "deaths", "cuts"].map((n) => bytes_of(data, n));
  const places = new Float32Array(9 * facts.triangles);
  const life = new Uint8Array(12 * facts.triangles);
  for (let i = 0; i < corners.length; ++i) {
    for (let k = 0; k < 3; ++k) {
      const [lo, hi] = [facts.box[0][k], facts.box[1][k]];
      places[3 * i + k] = lo + (hi - lo) * axes[k][corners[i]] / 65535;
    }
    const t = Math.floor(i / 3);
    life.set([births[t], deaths[t], cuts[t], 0], 4 * i);
  }
  return { places, normals: normals_of(places), life };
}
function normals_of(p) {
  const out = new Int8Array(p.length / 3 * 4);
  for (let i = 0; i < p.length; i += 9) {
    const u = [0, 1, 2].map((k) => p[i + 3 + k] - p[i + k]);
    const v = [0, 1, 2].map((k) => p[i + 6 + k] - p[i + k]);
    const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    const length = Math.hypot(...n) || 1;
    for (let c = 0; c < 3; ++c)
      for (let k = 0; k < 3; ++k) out[(i / 3 + c) * 4 + k] = Math.round(127 * n[k] / length);
  }
  return out;
}

const vertex_text = `
attribute vec3 place; attribute vec3 normal; attribute vec4 life;
uniform mat4 view; uniform mat4 model; uniform float frame; uniform float lives;
varying vec3 n; varying float cut;
void main() {
  bool gone = lives > 0.5 && (frame < life.x || (frame >= life.y && life.y < 254.5));
  gl_Position = gone ? vec4(2.0, 2.0, 2.0, 1.0) : view * model * vec4(place, 1.0);
  n = (model * vec4(normal, 0.0)).xyz; cut = lives * life.z; gl_PointSize = 12.0;
}`;
const fragment_text = `
precision mediump float;
uniform vec3 color; uniform vec3 cut_color; uniform float flat_light; uniform float alpha;
varying vec3 n; varying float cut;
void main() {
  vec3 c = mix(color, cut_color, cut);
  vec3 m = normalize(n + vec3(1e-6));
  float light = 0.42 + 0.4 * max(dot(m, normalize(vec3(-0.4, -0.7, 0.9))), 0.0)
    + 0.18 * max(dot(m, normalize(vec3(0.8, 0.3, 0.4))), 0.0);
  gl_FragColor = vec4(c * mix(light, 1.0, flat_light), alpha);
}`;

const dark = window.matchMedia("(prefers-color-scheme: dark)");
const canvas = by_id("view");
const gl = canvas.getContext("webgl", { antialias: true, preserveDrawingBuffer: true });
let program, uniforms = {};

function compiled(type, text) {
  const shader = gl.createShader(type);
  gl.shaderSource(shader, text);
  gl.compileShader(shader);
  if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw gl.getShaderInfoLog(shader);
  return shader;
}
function make_program() {
  program = gl.createProgram();
  gl.attachShader(program, compiled(gl.VERTEX_SHADER, vertex_text));
  gl.attachShader(program, compiled(gl.FRAGMENT_SHADER, fragment_text));
  ["place", "normal", "life"].forEach((name, i) => gl.bindAttribLocation(program, i, name));
  gl.linkProgram(program);
  gl.useProgram(program);
  for (const name of ["view", "model", "frame", "lives", "color", "cut_color", "flat_light",
    "alpha"]) uniforms[name] = gl.getUniformLocation(program, name);
  gl.enable(gl.DEPTH_TEST);
}
function buffer(array) {
  const out = gl.createBuffer();
  gl.bindBuffer(gl.ARRAY_BUFFER, out);
  gl.bufferData(gl.ARRAY_BUFFER, array, gl.STATIC_DRAW);
  return out;
}
function body(places, life) {
  return { count: places.length / 3, places: buffer(places), normals: buffer(normals_of(places)),
    life: life ? buffer(life) : null };
}
function draw(item, look, mode = gl.TRIANGLES, first = 0, count = item.count) {
  if (count <= 0) return;
  gl.bindBuffer(gl.ARRAY_BUFFER, item.places);
  gl.enableVertexAttribArray(0);
  gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
  const attribute = (i, array, size, type, normalized) => {
    if (!array) return gl.disableVertexAttribArray(i);
    gl.bindBuffer(gl.ARRAY_BUFFER, array);
    gl.enableVertexAttribArray(i);
    gl.vertexAttribPointer(i, size, type, normalized, 4, 0);
  };
  attribute(1, item.normals, 3, gl.BYTE, true);
  attribute(2, item.life, 4, gl.UNSIGNED_BYTE, false);
  gl.uniform1f(uniforms.lives, item.life ? 1 : 0);
  gl.uniform1f(uniforms.flat_light, item.normals ? 0 : 1);
  gl.uniform1f(uniforms.alpha, look.alpha || 1);
  gl.uniform3fv(uniforms.color, look.color);
  gl.uniform3fv(uniforms.cut_color, look.cut || look.color);
  gl.uniformMatrix4fv(uniforms.model, false, look.model || identity);
  gl.drawArrays(mode, first, count);
}
const identity = new Float32Array([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);

const hash = new URLSearchParams(location.hash.slice(1));
const number = (name, other) => hash.has(name) ? Number(hash.get(name)) : other;
const camera = { turn: number("turn", -0.9), tilt: number("tilt", 0.75), zoom: number("zoom", 1),
  shift: [0, 0] };
const center = [0, 1, 2].map((k) => (facts.box[0][k] + facts.box[1][k]) / 2);
const radius = 0.62 * Math.hypot(...[0, 1, 2].map((k) => facts.box[1][k] - facts.box[0][k])) || 1;

// Parallel rays; z of the model points up.
function view_matrix() {
  const [c, s, ct, st] = [Math.cos(camera.turn), Math.sin(camera.turn), Math.cos(camera.tilt),
    Math.sin(camera.tilt)];
  const right = [-s, c, 0], up = [-c * st, -s * st, ct], to_eye = [c * ct, s * ct, st];
  const scale = camera.zoom / radius;
  const aspect = canvas.width / canvas.height;
  const sx = aspect > 1 ? scale / aspect : scale, sy = aspect > 1 ? scale : scale * aspect;
  const sz = -0.1 / radius;
  const dot = (a) => a[0] * center[0] + a[1] * center[1] + a[2] * center[2];
  return new Float32Array([right[0] * sx, up[0] * sy, to_eye[0] * sz, 0,
    right[1] * sx, up[1] * sy, to_eye[1] * sz, 0, right[2] * sx, up[2] * sy, to_eye[2] * sz, 0,
    camera.shift[0] - dot(right) * sx, camera.shift[1] - dot(up) * sy, -dot(to_eye) * sz, 1]);
}

let scene = null, step = 0;
const step_size = 8;
const position = (i) => scene.steps.subarray(step_size * i, step_size * i + 3);
function pose(i) {
  const m = facts.orientations[scene.steps[step_size * i + 6]], p = position(i);
  return new Float32Array([m[0], m[3], m[6], 0, m[1], m[4], m[7], 0, m[2], m[5], m[8], 0,
    p[0], p[1], p[2], 1]);
}
function redraw() {
  if (!scene) return;
  const ratio = window.devicePixelRatio || 1;
  canvas.width = canvas.clientWidth * ratio;
  canvas.height = canvas.clientHeight * ratio;
  gl.viewport(0, 0, canvas.width, canvas.height);
  if (dark.matches) gl.clearColor(0.125, 0.149, 0.18, 1);
  else gl.clearColor(0.933, 0.945, 0.961, 1);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  gl.uniformMatrix4fv(uniforms.view, false, view_matrix());
  let frame = 0;
  while (frame + 1 < facts.frames.length && facts.frames[frame + 1] <= step) ++frame;
  gl.uniform1f(uniforms.frame, frame);
  draw(scene.stock, { color: [0.72, 0.77, 0.84], cut: [0.96, 0.78, 0.42] });
  if (by_id("show_fixtures").checked) draw(scene.fixtures, { color: [0.55, 0.46, 0.4] });
  const hits = facts.collisions.filter((c) => c.step === step);
  if (step > 0 && by_id("show_tool").checked) {
    const model = pose(step - 1);
    draw(scene.tool, { color: [0.3, 0.62, 0.4], model });
    draw(scene.holder, { color: hits.length ? [0.9, 0.2, 0.15] : [0.45, 0.5, 0.58], model });
  }
  if (by_id("show_path").checked)
    draw(scene.path, { color: [0.16, 0.36, 0.75] }, gl.LINE_STRIP, Math.max(0, step - 400),
      Math.min(step, 400));
  gl.disable(gl.DEPTH_TEST);
  for (const c of hits)
    if (c.place) draw(point_body(c.place), { color: [0.85, 0, 0] }, gl.POINTS);
  gl.enable(gl.DEPTH_TEST);
  show_facts(frame, hits);
}
const point_bodies = new Map();
function point_body(place) {
  const key = place.join();
  if (!point_bodies.has(key))
    point_bodies.set(key, { count: 1, places: buffer(new Float32Array(place)) });
  return point_bodies.get(key);
}
function show_facts(frame, hits) {
  if (step === 0) {
    by_id("facts").textContent = `before the first of ${facts.step_count} steps`;
    return;
  }
  const s = scene.steps.subarray(step_size * (step - 1), step_size * step);
  const minutes = Math.floor(s[3] / 60), seconds = (s[3] % 60).toFixed(1).padStart(4, "0");
  by_id("facts").textContent = `step ${step} of ${facts.step_count}, line ${s[4]}, ` +
    `${minutes}:${seconds}, removed ${s[5].toPrecision(4)}, ` +
    `in all ${scene.sums[step].toPrecision(6)}; the stock is that after step ` +
    `${facts.frames[frame]}` + (hits.length ? "; COLLISION" : "");
}
function set_step(value) {
  step = Math.max(0, Math.min(scene.count, value));
  by_id("slider").value = step;
  redraw();
}
function draw_graph() {
  const graph = by_id("graph"), context = graph.getContext("2d");
  graph.width = graph.clientWidth;
  graph.height = graph.clientHeight;
  const columns = new Float32Array(graph.width);
  for (let i = 0; i < scene.count; ++i) {
    const x = Math.min(graph.width - 1, Math.floor(i / scene.count * graph.width));
    columns[x] = Math.max(columns[x], scene.steps[step_size * i + 5]);
  }
  const most = columns.reduce((a, b) => Math.max(a, b), 1e-300);
  context.fillStyle = "#7f9dc4";
  columns.forEach((v, x) => context.fillRect(x, graph.height * (1 - Math.sqrt(v / most)), 1, graph.height));
  context.fillStyle = "#d22";
  for (const c of facts.collisions)
    context.fillRect(c.step / scene.count * graph.width - 1, 0, 3, graph.height);
}
function list_collisions() {
  const list = by_id("list");
  const add = (text, kind) => {
    const item = document.createElement("div");
    item.textContent = text;
    item.className = kind;
    list.append(item);
    return item;
  };
  if (!facts.collisions.length) add(`no collision in ${scene.count} steps`, "none");
  for (const c of facts.collisions.slice(0, 50)) {
    const contact = c.contacts[0];
    add(`step ${c.step}, line ${c.line}, ${c.time.toFixed(1)} s: ${c.kind} (${c.b}, ` +
      `${c.relation})` + (contact ? `\n${contact.a.name} meets ${contact.b.name}` : ""), "hit").onclick = () => set_step(c.step);
  }
}
function listen() {
  let drag = null;
  canvas.onpointerdown = (e) => { drag = [e.clientX, e.clientY]; canvas.setPointerCapture(e.pointerId); };
  canvas.onpointerup = () => { drag = null; };
  canvas.onpointermove = (e) => {
    if (!drag) return;
    const [dx, dy] = [e.clientX - drag[0], e.clientY - drag[1]];
    drag = [e.clientX, e.clientY];
    if (e.shiftKey || e.buttons === 2) {
      camera.shift[0] += 2 * dx / canvas.clientWidth;
      camera.shift[1] -= 2 * dy / canvas.clientHeight;
    } else {
      camera.turn -= dx * 0.008;
      camera.tilt = Math.max(-1.55, Math.min(1.55, camera.tilt + dy * 0.008));
    }
    redraw();
  };
  canvas.oncontextmenu = (e) => e.preventDefault();
  canvas.onwheel = (e) => {
    e.preventDefault();
    camera.zoom *= Math.exp(-e.deltaY * 0.001);
    redraw();
  };
  by_id("slider").oninput = (e) => set_step(Number(e.target.value));
  for (const id of ["show_tool", "show_fixtures", "show_path"]) by_id(id).onchange = redraw;
  let timer = null;
  by_id("play").onclick = () => {
    if (timer) { clearInterval(timer); timer = null; by_id("play").textContent = "play"; return; }
    if (step >= scene.count) step = 0;
    by_id("play").textContent = "pause";
    const stride = Math.max(1, Math.round(scene.count / 900));
    timer = setInterval(() => {
      set_step(step + stride);
      if (step >= scene.count) by_id("play").click();
    }, 33);
  };
  window.onresize = () => { draw_graph(); redraw(); };
  dark.onchange = window.onresize;
  listen_to_keys();
}
// Space plays, comma and dot are a step, C goes to the next collision; in the picture arrows turn.
function listen_to_keys() {
  document.addEventListener("keydown", (e) => {
    const turn = (by, tilt) => {
      camera.turn += by;
      camera.tilt = Math.max(-1.55, Math.min(1.55, camera.tilt + tilt));
      redraw();
    };
    const in_picture = { ArrowLeft: () => turn(0.1, 0), ArrowRight: () => turn(-0.1, 0),
      ArrowUp: () => turn(0, 0.1), ArrowDown: () => turn(0, -0.1),
      "+": () => { camera.zoom *= 1.1; redraw(); }, "-": () => { camera.zoom /= 1.1; redraw(); } };
    const next = facts.collisions.find((c) => c.step > step) || facts.collisions[0];
    const anywhere = { " ": () => by_id("play").click(), ",": () => set_step(step - 1),
      ".": () => set_step(step + 1), c: () => { if (next) set_step(next.step); } };
    const action = anywhere[e.key] || (document.activeElement === canvas && in_picture[e.key]);
    if (!action || e.ctrlKey || e.metaKey || (e.key === " " && /BUTTON|INPUT/.test(e.target.tagName)))
      return;
    e.preventDefault();
    action();
  });
}
async function start() {
  if (!gl) throw "this page needs WebGL";
  make_program();
  const data = await unpacked();
  const arrays = stock_arrays(data);
  const steps = floats_of(data, "steps"), count = steps.length / step_size;
  const path = new Float32Array(3 * count), sums = new Float64Array(count + 1);
  for (let i = 0; i < count; ++i) {
    path.set(steps.subarray(step_size * i, step_size * i + 3), 3 * i);
    sums[i + 1] = sums[i] + steps[step_size * i + 5];
  }
  scene = { steps, count, sums,
    stock: { count: arrays.places.length / 3, places: buffer(arrays.places),
      normals: buffer(arrays.normals), life: buffer(arrays.life) },
    tool: body(floats_of(data, "tool")), holder: body(floats_of(data, "holder")),
    fixtures: body(floats_of(data, "fixtures")), path: { count, places: buffer(path) } };
  by_id("slider").max = count;
  by_id("busy").remove();
  listen();
  list_collisions();
  draw_graph();
  const first = facts.collisions.length ? facts.collisions[0].step : count;
  set_step(number("step", first));
  document.title += `: ${facts.path}`;
}
start().catch((e) => { by_id("busy").textContent = "cannot show the stock: " + e; });
</script>
</body>
</html>
)html";

}  // namespace trisect::app
