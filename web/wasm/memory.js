// SPDX-License-Identifier: Apache-2.0
//
// The module's instance and its memory: arrays in and out, handles, and statuses as exceptions.

const statusNames = new Map([
  [2, 'usage'],
  [3, 'input'],
  [4, 'invalid_solid'],
  [5, 'limit'],
  [6, 'cancelled'],
  [7, 'unsupported'],
  [70, 'internal'],
  [71, 'no_memory'],
]);

export class TrisectError extends Error {
  constructor(status, message) {
    super(message);
    this.name = 'TrisectError';
    this.kind = statusNames.get(status) ?? 'internal';
  }
}

let exports = null; // of the instance
let hasAll = false;
let buffer = null; // its memory, as `view` saw it last
let view = null;
const encoder = new TextEncoder();
const decoder = new TextDecoder();

function data() {
  if (buffer !== exports.memory.buffer) {
    buffer = exports.memory.buffer; // it grew
    view = new DataView(buffer);
  }
  return view;
}

// What the C library asks of its surroundings: time, and a place for the message of an abort().
const surroundings = {
  clock_time_get(_clock, _precision, at) {
    data().setBigUint64(at, BigInt(Math.round(performance.now() * 1e6)), true);
    return 0;
  },
  fd_write(_file, parts, count, written) {
    let text = '';
    for (let i = 0; i < count; ++i) {
      const from = data().getUint32(parts + 8 * i, true);
      text += decoder.decode(new Uint8Array(buffer, from, data().getUint32(parts + 8 * i + 4, true)));
    }
    console.error(text);
    data().setUint32(written, encoder.encode(text).length, true);
    return 0;
  },
  proc_exit(code) {
    throw new TrisectError(70, `the module ended with ${code}`);
  },
};

function notLoaded() {
  throw new TrisectError(2, 'this is in trisect-more.wasm: await init() without { more: false } first');
}

// Any other function that the C library has an import for: nothing is there. In place of functions of the
// second module are some that say so.
function importsOf(module) {
  const imports = {};
  for (const { module: from, name, kind } of WebAssembly.Module.imports(module)) {
    if (kind !== 'function') continue;
    imports[from] ??= {};
    imports[from][name] = from === 'placeholder' ? notLoaded : surroundings[name] ?? (() => (from === 'env' ? undefined : 52));
  }
  return imports;
}

export async function instantiate(module) {
  const instance = await WebAssembly.instantiate(module, importsOf(module));
  exports = instance.exports;
  buffer = null;
  exports._initialize?.();
}

/** Puts the functions of the second module into the first one's table. It works on the same memory. */
export async function instantiateMore(module) {
  await WebAssembly.instantiate(module, { primary: exports });
  hasAll = true;
}

export const isReady = () => exports !== null;
export const isWhole = () => hasAll;

/** Calls a function of the interface that gives no status. */
export function ask(name, ...words) {
  if (exports === null) throw new TrisectError(2, 'await init() first');
  return exports['trisect_' + name](...words);
}

export function textAt(at) {
  let end = at;
  while (data().getUint8(end) !== 0) ++end;
  return decoder.decode(new Uint8Array(buffer, at, end - at));
}

/** Calls one that gives a status. */
export function call(name, ...words) {
  const status = ask(name, ...words);
  if (status !== 0) throw new TrisectError(status, textAt(exports.trisect_error_message()));
}

/** Memory of one call, given back when `use` returns. */
export function withMemory(use) {
  if (exports === null) throw new TrisectError(2, 'await init() first');
  const taken = [];
  const take = (bytes) => {
    const at = exports.malloc(Math.max(bytes, 8));
    if (at === 0) throw new TrisectError(71, 'out of memory');
    taken.push(at);
    return at;
  };
  const put = (Type, numbers) => {
    const at = take(numbers.length * Type.BYTES_PER_ELEMENT);
    data();
    new Type(buffer, at, numbers.length).set(numbers);
    return at;
  };
  try {
    return use({
      take,
      put,
      /** A text's place and length in bytes. */
      text: (text) => {
        const bytes = encoder.encode(text);
        return [put(Uint8Array, bytes), bytes.length];
      },
    });
  } finally {
    for (const at of taken) exports.free(at);
  }
}

/** A copy of numbers in the module's memory. */
export function copy(Type, at, count) {
  data();
  return count === 0 ? new Type(0) : new Type(buffer, at, count).slice();
}
export const wordAt = (at) => data().getUint32(at, true);
export const numberAt = (at) => data().getFloat64(at, true);

/** The handle that a call writes through its last argument. */
export function made(name, ...words) {
  return withMemory(({ take }) => {
    const out = take(4);
    call(name, ...words, out);
    return wordAt(out);
  });
}

/** The doubles that a call writes through its last argument. */
export function doubles(count, name, ...words) {
  return withMemory(({ take }) => {
    const out = take(8 * count);
    call(name, ...words, out);
    return copy(Float64Array, out, count);
  });
}

const forgotten = new FinalizationRegistry(({ free, at }) => ask(free, at));

/** An object of the module. It is given back by delete(), by `using`, or some time after it is forgotten. */
export class Handle {
  #at;
  #free;
  constructor(at, free) {
    this.#at = at;
    this.#free = free;
    forgotten.register(this, { free, at }, this);
  }
  get at() {
    if (this.#at === 0) throw new TrisectError(2, `this ${this.constructor.name} was deleted`);
    return this.#at;
  }
  delete() {
    if (this.#at === 0) return;
    forgotten.unregister(this);
    ask(this.#free, this.#at);
    this.#at = 0;
  }
}
if (Symbol.dispose) {
  Handle.prototype[Symbol.dispose] = function () {
    this.delete();
  };
}
