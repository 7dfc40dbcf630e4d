// SPDX-License-Identifier: Apache-2.0
//
// Trisect for JavaScript: solids and what is asked of them, over the C interface in WebAssembly.
// trisect.d.ts has the types and says what everything means.

import { ask, call, copy, doubles, Handle, instantiate, instantiateMore, isReady, isWhole, made, numberAt, textAt, TrisectError, withMemory, wordAt } from './memory.js';

export { TrisectError };

const operations = { union: 0, intersection: 1, difference: 2, xor: 3 };
const embeddings = { assume: 0, resolve: 1, check: 2 };
export const Location = Object.freeze({ OUTSIDE: 0, ON_FACE: 1, ON_EDGE: 2, ON_VERTEX: 3, INSIDE: 4 });
const relations = ['disjoint', 'touching', 'overlapping', 'inside', 'contains', 'equal'];
const verdicts = ['equal', 'within', 'different', 'undecided', 'not_closed'];

async function moduleOf(source, name) {
  if (source instanceof WebAssembly.Module) return source;
  if (source instanceof ArrayBuffer || ArrayBuffer.isView(source)) return WebAssembly.compile(source);
  const address = new URL(source ?? name, import.meta.url);
  if (address.protocol === 'file:' && globalThis.process?.versions?.node) {
    const { readFile } = await import('node:fs/promises');
    return WebAssembly.compile(await readFile(address));
  }
  const answer = await fetch(address);
  if (!answer.ok) throw new TrisectError(3, `${address}: ${answer.status}`);
  return WebAssembly.compile(await answer.arrayBuffer());
}

let starting = null;
let adding = null;

export async function init(source, { more } = {}) {
  if (!isReady()) starting ??= moduleOf(source, 'trisect.wasm').then(instantiate).catch((error) => {
    starting = null;
    throw error;
  });
  if (more !== false && !isWhole()) {
    // Both are fetched at once, whichever comes first.
    adding ??= Promise.all([moduleOf(more, 'trisect-more.wasm'), starting]).then(([found]) => instantiateMore(found)).catch((error) => {
      adding = null;
      throw error;
    });
  }
  await starting;
  if (more !== false) await adding;
}

function usage(message) {
  throw new TrisectError(2, message);
}
function numbers(values, count, name) {
  const list = Float64Array.from(values);
  if (count !== undefined && list.length !== count) usage(`${name}: ${count} numbers are needed, not ${list.length}`);
  return list;
}
function triples(values, name) {
  const list = values instanceof Float64Array ? values : Float64Array.from(values);
  if (list.length % 3 !== 0) usage(`${name}: ${list.length} numbers are no whole points`);
  return list;
}
function words(values, name) {
  if (values instanceof Uint32Array) return values;
  return Uint32Array.from(values, (v) => {
    if (!Number.isInteger(v) || v < 0 || v > 0xffffffff) usage(`${name}: ${v} is no index`);
    return v;
  });
}
function solidsOf(operands) {
  for (const s of operands) if (!(s instanceof Solid)) usage('an operand is no Solid');
  return operands;
}
function choice(table, value, name) {
  if (!Object.hasOwn(table, value)) usage(`${name}: "${value}" is none of ${Object.keys(table).join(', ')}`);
  return table[value];
}
function takeText(at) {
  const text = textAt(ask('text_data', at, 0));
  ask('text_free', at);
  return text;
}

const triangles = (memory, vertices, faces) => {
  const v = triples(vertices, 'vertices');
  const f = words(faces, 'faces');
  if (f.length % 3 !== 0) usage(`faces: ${f.length} indices are no whole triangles`);
  return [memory.put(Float64Array, v), v.length / 3, memory.put(Uint32Array, f), f.length / 3];
};

function fromArrays(vertices, faces, { embedding = 'assume', faceBegin, acceptInsideOut = false } = {}) {
  return withMemory((memory) => {
    const options = memory.put(Uint32Array, [12, choice(embeddings, embedding, 'embedding'), acceptInsideOut ? 1 : 0]);
    if (faceBegin === undefined)
      return made('solid_from_triangles', ...triangles(memory, vertices, faces), options);
    const v = triples(vertices, 'vertices');
    const f = words(faces, 'faces');
    const begin = words(faceBegin, 'faceBegin');
    if (begin.length === 0 || begin[begin.length - 1] !== f.length)
      usage(`faceBegin: ends with ${begin.at(-1)}, and there are ${f.length} corners`);
    return made('solid_from_polygons', memory.put(Float64Array, v), v.length / 3, memory.put(Uint32Array, f),
      memory.put(Uint32Array, begin), begin.length - 1, options);
  });
}

function boolean(operation, operands) {
  return withMemory(({ put }) => {
    const handles = put(Uint32Array, solidsOf(operands).map((s) => s.at));
    return Solid.of(made('boolean', operation, handles, operands.length));
  });
}

const fromHandle = Symbol('from a handle');

export class Solid extends Handle {
  constructor(vertices, faces, options) {
    super(vertices === fromHandle ? faces : fromArrays(vertices, faces, options), 'solid_free');
  }
  /** @internal */
  static of(at) {
    return new Solid(fromHandle, at);
  }

  static empty() {
    return Solid.of(made('solid_empty'));
  }
  static wholeSpace() {
    return Solid.of(made('solid_whole_space'));
  }
  static halfSpace(plane) {
    return withMemory(({ put }) => Solid.of(made('solid_half_space', put(Float64Array, numbers(plane, 4, 'plane')))));
  }
  static box(low, high) {
    return withMemory(({ put }) =>
      Solid.of(made('solid_box', put(Float64Array, numbers(low, 3, 'low')), put(Float64Array, numbers(high, 3, 'high')))));
  }
  static cylinder(radius, height, segments = 64) {
    return Solid.of(made('solid_cylinder', radius, height, segments));
  }
  static cone(bottomRadius, topRadius, height, segments = 64) {
    return Solid.of(made('solid_cone', bottomRadius, topRadius, height, segments));
  }
  static sphere(radius, subdivisions = 3) {
    return Solid.of(made('solid_sphere', radius, subdivisions));
  }
  static torus(majorRadius, minorRadius, majorSegments = 64, minorSegments = 32) {
    return Solid.of(made('solid_torus', majorRadius, minorRadius, majorSegments, minorSegments));
  }
  static fromExactText(text) {
    return withMemory((memory) => Solid.of(made('solid_from_exact_text', ...memory.text(text))));
  }
  static fromCsg(text) {
    return withMemory((memory) => Solid.of(made('solid_from_csg', ...memory.text(text))));
  }

  union(...others) {
    return boolean(operations.union, [this, ...others]);
  }
  intersection(...others) {
    return boolean(operations.intersection, [this, ...others]);
  }
  difference(...others) {
    return boolean(operations.difference, [this, ...others]);
  }
  xor(...others) {
    return boolean(operations.xor, [this, ...others]);
  }
  complement() {
    return Solid.of(made('complement', this.at));
  }
  copy() {
    return Solid.of(made('solid_copy', this.at));
  }

  split(by) {
    return withMemory(({ take, put }) => {
      const out = take(8);
      if (by instanceof Solid) call('split', this.at, by.at, out, out + 4);
      else call('split_by_plane', this.at, put(Float64Array, numbers(by, 4, 'plane')), out, out + 4);
      return [Solid.of(wordAt(out)), Solid.of(wordAt(out + 4))];
    });
  }
  components() {
    const list = made('components', this.at);
    try {
      const count = ask('solid_list_count', list);
      return Array.from({ length: count }, (_, i) => Solid.of(made('solid_list_get', list, i)));
    } finally {
      ask('solid_list_free', list);
    }
  }

  transform(rows) {
    return this.transformWithReport(rows).solid;
  }
  transformWithReport(rows) {
    return withMemory(({ take, put }) => {
      const largestMove = take(8);
      const at = made('solid_transform', this.at, put(Float64Array, numbers(rows, 12, 'rows')), largestMove);
      return { solid: Solid.of(at), largestMove: numberAt(largestMove) };
    });
  }
  translate([x, y, z]) {
    return this.transform([1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z]);
  }
  scale(by) {
    const [x, y, z] = typeof by === 'number' ? [by, by, by] : by;
    return this.transform([x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, 0]);
  }
  rotate(axis, degrees) {
    return this.transform(rotation(axis, degrees));
  }

  mesh() {
    const at = made('solid_mesh', this.at);
    try {
      const faceCount = ask('mesh_face_count', at);
      return {
        vertices: copy(Float64Array, ask('mesh_vertices', at), 3 * ask('mesh_vertex_count', at)),
        faces: copy(Uint32Array, ask('mesh_faces', at), 3 * faceCount),
        sources: copy(Uint32Array, ask('mesh_sources', at), 2 * faceCount),
      };
    } finally {
      ask('mesh_free', at);
    }
  }
  get sourceId() {
    return made('solid_source_id', this.at);
  }
  get isEmpty() {
    return made('solid_is_empty', this.at) !== 0;
  }
  get isWholeSpace() {
    return made('solid_is_whole_space', this.at) !== 0;
  }
  equals(other) {
    return made('solid_equals', this.at, other.at) !== 0;
  }
  get exactText() {
    return takeText(made('solid_exact_text', this.at));
  }

  get volume() {
    return doubles(1, 'volume', this.at)[0];
  }
  get area() {
    return doubles(1, 'area', this.at)[0];
  }
  get exactVolume() {
    return takeText(made('exact_volume', this.at));
  }
  get centroid() {
    return [...doubles(3, 'centroid', this.at)];
  }
  get bounds() {
    return withMemory(({ take }) => {
      const out = take(48);
      call('bounds', this.at, out, out + 24);
      const all = [...copy(Float64Array, out, 6)];
      return { low: all.slice(0, 3), high: all.slice(3) };
    });
  }

  locate(points) {
    return withMemory(({ take, put }) => {
      const list = triples(points, 'points');
      const out = take(list.length / 3);
      call('locate', this.at, put(Float64Array, list), list.length / 3, out);
      return copy(Uint8Array, out, list.length / 3);
    });
  }
  firstHits(origins, directions) {
    return withMemory(({ take, put }) => {
      const from = triples(origins, 'origins');
      const along = triples(directions, 'directions');
      if (from.length !== along.length) usage(`${from.length / 3} origins, ${along.length / 3} directions`);
      const count = from.length / 3;
      const [parameters, faces] = [take(8 * count), take(8 * count)];
      call('first_hits', this.at, put(Float64Array, from), put(Float64Array, along), count, parameters, faces);
      return { parameters: copy(Float64Array, parameters, count), faces: copy(Uint32Array, faces, 2 * count) };
    });
  }
  firstHit(origin, direction) {
    const { parameters, faces } = this.firstHits(numbers(origin, 3, 'origin'), numbers(direction, 3, 'direction'));
    return parameters[0] === Infinity ? null : { parameter: parameters[0], operand: faces[0], face: faces[1] };
  }
  signedDistances(points) {
    return withMemory(({ take, put }) => {
      const list = triples(points, 'points');
      const out = take((8 * list.length) / 3);
      call('signed_distances', this.at, put(Float64Array, list), list.length / 3, out);
      return copy(Float64Array, out, list.length / 3);
    });
  }
  section(plane) {
    return withMemory(({ take, put }) => {
      const at = made('solid_section', this.at, put(Float64Array, numbers(plane, 4, 'plane')));
      try {
        const count = take(4);
        return Array.from({ length: ask('section_loop_count', at) }, (_, i) => {
          const points = ask('section_points', at, i, count);
          return {
            region: ask('section_region', at, i),
            isHole: ask('section_is_hole', at, i) !== 0,
            points: copy(Float64Array, points, 3 * wordAt(count)),
          };
        });
      } finally {
        ask('section_free', at);
      }
    });
  }
}

export const union = (operands) => boolean(operations.union, [...operands]);
export const intersection = (operands) => boolean(operations.intersection, [...operands]);
export const xor = (operands) => boolean(operations.xor, [...operands]);
export const difference = (from, others) => boolean(operations.difference, [from, ...others]);

function rotation(axis, degrees) {
  const length = Math.hypot(...numbers(axis, 3, 'axis'));
  if (!(length > 0)) usage('axis: has no direction');
  const [x, y, z] = axis.map((v) => v / length);
  // Of quarter turns no rounding is left.
  const quarters = degrees / 90;
  const whole = Number.isInteger(quarters) ? ((quarters % 4) + 4) % 4 : -1;
  const angle = (degrees * Math.PI) / 180;
  const c = whole < 0 ? Math.cos(angle) : [1, 0, -1, 0][whole];
  const s = whole < 0 ? Math.sin(angle) : [0, 1, 0, -1][whole];
  const d = 1 - c;
  return [
    d * x * x + c, d * x * y - s * z, d * x * z + s * y, 0,
    d * x * y + s * z, d * y * y + c, d * y * z - s * x, 0,
    d * x * z - s * y, d * y * z + s * x, d * z * z + c, 0,
  ];
}

export class Pose extends Handle {
  constructor(rows) {
    super(rows === fromHandle ? arguments[1] : withMemory(({ put }) => made('pose_from_rows', put(Float64Array, numbers(rows, 12, 'rows')))), 'pose_free');
  }
  static translation([x, y, z]) {
    return new Pose([1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z]);
  }
  static fromQuaternion(quaternion, translation = [0, 0, 0]) {
    return withMemory(({ put }) =>
      new Pose(fromHandle, made('pose_from_quaternion', put(BigInt64Array, integers(quaternion, 4, 'quaternion')),
        put(Float64Array, numbers(translation, 3, 'translation')))));
  }
  times(other) {
    return new Pose(fromHandle, made('pose_product', this.at, other.at));
  }
  inverse() {
    return new Pose(fromHandle, made('pose_inverse', this.at));
  }
  get rows() {
    return [...doubles(12, 'pose_rows', this.at)];
  }
}

function integers(values, count, name) {
  const list = [...values].map((v) => BigInt(v));
  if (list.length !== count) usage(`${name}: ${count} integers are needed, not ${list.length}`);
  return list;
}
const placed = (a, poseA, b, poseB) => [a.at, poseA?.at ?? 0, b.at, poseB?.at ?? 0];

export const interfere = (a, poseA, b, poseB) => relations[made('interfere', ...placed(a, poseA, b, poseB))];
export function distance(a, poseA, b, poseB) {
  return withMemory(({ take }) => {
    const out = take(16);
    call('distance', ...placed(a, poseA, b, poseB), out, out + 8);
    const [lower, upper] = copy(Float64Array, out, 2);
    return { lower, upper };
  });
}
export const areNearerThan = (a, poseA, b, poseB, distance) =>
  made('are_nearer_than', ...placed(a, poseA, b, poseB), distance) !== 0;

export class Motion extends Handle {
  constructor(at) {
    super(at ?? made('motion_still', 0), 'motion_free');
  }
  static still(pose) {
    return new Motion(made('motion_still', pose?.at ?? 0));
  }
  static translation(pose, by) {
    return withMemory(({ put }) =>
      new Motion(made('motion_translation', pose?.at ?? 0, put(Float64Array, numbers(by, 3, 'by')))));
  }
  static screw(pose, quaternion, center, shift = [0, 0, 0]) {
    return withMemory(({ put }) =>
      new Motion(made('motion_screw', pose?.at ?? 0, put(BigInt64Array, integers(quaternion, 4, 'quaternion')),
        put(Float64Array, numbers(center, 3, 'center')), put(Float64Array, numbers(shift, 3, 'shift')))));
  }
}

export function firstContact(a, motionA, b, motionB, { untilOverlap = false } = {}) {
  return withMemory(({ take }) => {
    const out = take(16);
    call('first_contact', ...placed(a, motionA, b, motionB), untilOverlap ? 1 : 0, out, out + 8);
    return wordAt(out) === 0 ? null : numberAt(out + 8);
  });
}

export class Scene extends Handle {
  constructor() {
    super(made('scene_create'), 'scene_free');
  }
  #withBody(body, use) {
    // Structs are passed by their place.
    return withMemory(({ put }) => use(put(Uint32Array, [body.index, body.generation])));
  }
  add(solid, pose) {
    return withMemory(({ take }) => {
      const out = take(8);
      call('scene_add', this.at, solid.at, pose?.at ?? 0, out);
      return Object.freeze({ index: wordAt(out), generation: wordAt(out + 4) });
    });
  }
  setPose(body, pose) {
    this.#withBody(body, (at) => call('scene_set_pose', this.at, at, pose?.at ?? 0));
  }
  replace(body, solid) {
    this.#withBody(body, (at) => call('scene_replace', this.at, at, solid.at));
  }
  remove(body) {
    this.#withBody(body, (at) => call('scene_remove', this.at, at));
  }
  interfering() {
    return withMemory(({ take }) => {
      const out = take(8);
      call('scene_interfering', this.at, out, out + 4);
      const [pairs, count] = [wordAt(out), wordAt(out + 4)];
      return Array.from({ length: count }, (_, i) => {
        const [a, ofA, b, ofB, relation] = copy(Uint32Array, pairs + 20 * i, 5);
        return { a: { index: a, generation: ofA }, b: { index: b, generation: ofB }, relation: relations[relation] };
      });
    });
  }
}

export function check(vertices, faces) {
  return withMemory((memory) => {
    const report = made('check', ...triangles(memory, vertices, faces));
    try {
      const at = memory.take(56);
      const findings = Array.from({ length: ask('report_count', report) }, (_, i) => {
        call('report_finding', report, i, at);
        return {
          kind: textAt(wordAt(at)),
          isError: wordAt(at + 4) !== 0,
          place: [...copy(Float64Array, at + 8, 3)],
          sentence: textAt(wordAt(at + 32)),
          vertices: copy(Uint32Array, wordAt(at + 36), wordAt(at + 40)),
          faces: copy(Uint32Array, wordAt(at + 44), wordAt(at + 48)),
        };
      });
      return { isSolid: ask('report_is_solid', report) !== 0, findings };
    } finally {
      ask('report_free', report);
    }
  });
}

export function verify(operation, operands, result, within = -1) {
  return withMemory((memory) => {
    const lists = [...operands, result].map(({ vertices, faces }) => triangles(memory, vertices, faces));
    const at = memory.put(Uint32Array, lists.flat());
    const out = memory.take(24);
    call('verify', choice(operations, operation, 'operation'), at, operands.length, at + 16 * operands.length, within,
      out, out + 8, out + 16);
    return { verdict: verdicts[wordAt(out)], lower: numberAt(out + 8), upper: numberAt(out + 16) };
  });
}

export function setLimits({ maxWork = 0, maxMemory = 0 } = {}) {
  withMemory(({ put }) =>
    call('set_limits', put(BigUint64Array, [32n, BigInt(maxWork), BigInt(maxMemory), 0n])));
}
export const version = () => textAt(ask('version'));
