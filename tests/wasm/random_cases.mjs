// SPDX-License-Identifier: Apache-2.0
//
// Random booleans for package_test.mjs: operands as arrays, drawn from a seed.

/** Numbers below 1 by Steele, Lea and Flood's SplitMix64 (2014). */
export class Random {
  constructor(seed) {
    this.state = BigInt(seed);
  }
  bits() {
    this.state = BigInt.asUintN(64, this.state + 0x9e3779b97f4a7c15n);
    let z = this.state;
    z = BigInt.asUintN(64, (z ^ (z >> 30n)) * 0xbf58476d1ce4e5b9n);
    z = BigInt.asUintN(64, (z ^ (z >> 27n)) * 0x94d049bb133111ebn);
    return z ^ (z >> 31n);
  }
  number() {
    return Number(this.bits() >> 11n) / 2 ** 53;
  }
  between(low, high) {
    return low + (high - low) * this.number();
  }
  /** 0, ..., below - 1 */
  index(below) {
    return Math.floor(this.number() * below);
  }
}

const grid = (rows, columns, point) => {
  const vertices = [];
  const faces = [];
  for (let i = 0; i < rows; ++i) for (let k = 0; k < columns; ++k) vertices.push(...point(i / rows, k / columns));
  for (let i = 0; i < rows; ++i)
    for (let k = 0; k < columns; ++k) {
      const at = (a, b) => ((i + a) % rows) * columns + ((k + b) % columns);
      faces.push(at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1));
    }
  return { vertices, faces };
};

const torus = (random) => {
  const thick = random.between(0.1, 0.4);
  return grid(4 + random.index(30), 3 + random.index(20), (u, v) => {
    const [a, b] = [2 * Math.PI * u, 2 * Math.PI * v];
    const r = 1 + thick * Math.cos(b);
    return [r * Math.cos(a), r * Math.sin(a), thick * Math.sin(b)];
  });
};

const ball = (random) => {
  const [rows, columns] = [3 + random.index(24), 3 + random.index(32)];
  const vertices = [0, 0, -1];
  const faces = [];
  for (let i = 1; i < rows; ++i)
    for (let k = 0; k < columns; ++k) {
      const [a, b] = [Math.PI * (i / rows - 0.5), (2 * Math.PI * k) / columns];
      vertices.push(Math.cos(a) * Math.cos(b), Math.cos(a) * Math.sin(b), Math.sin(a));
    }
  const top = vertices.length / 3;
  vertices.push(0, 0, 1);
  const at = (i, k) => 1 + (i - 1) * columns + (k % columns);
  for (let k = 0; k < columns; ++k) {
    faces.push(0, at(1, k + 1), at(1, k));
    for (let i = 1; i < rows - 1; ++i)
      faces.push(at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i, k), at(i + 1, k + 1), at(i + 1, k));
    faces.push(top, at(rows - 1, k), at(rows - 1, k + 1));
  }
  return { vertices, faces };
};

const boxFaces = [0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5];
const box = (low, high) => ({
  vertices: Array.from({ length: 8 }, (_, i) => [0, 1, 2].map((k) => ((i >> k) & 1 ? high : low)[k])).flat(),
  faces: boxFaces,
});

// Faces of different operands coincide all the time.
const latticeBox = (random) => {
  const low = [0, 1, 2].map(() => random.index(4));
  return box(low, low.map((l) => l + 1 + random.index(3)));
};

const latticeTetrahedron = (random) => {
  for (;;) {
    const p = Array.from({ length: 4 }, () => [0, 1, 2].map(() => random.index(5)));
    const [u, v, w] = [1, 2, 3].map((i) => p[i].map((x, k) => x - p[0][k]));
    const volume =
      u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
    if (volume === 0) continue;
    const faces = [0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2];
    return { vertices: p.flat(), faces: volume > 0 ? faces : faces.toReversed?.() ?? [...faces].reverse() };
  }
};

function moved({ vertices, faces }, random) {
  const axis = [0, 1, 2].map(() => random.between(-1, 1));
  const length = Math.hypot(...axis);
  const [x, y, z] = axis.map((v) => v / length);
  const angle = random.between(0, 7);
  const [c, s, d] = [Math.cos(angle), Math.sin(angle), 1 - Math.cos(angle)];
  const rows = [
    [d * x * x + c, d * x * y - s * z, d * x * z + s * y],
    [d * x * y + s * z, d * y * y + c, d * y * z - s * x],
    [d * x * z - s * y, d * y * z + s * x, d * z * z + c],
  ];
  const shift = [0, 1, 2].map(() => random.between(-0.8, 0.8));
  const size = random.between(0.5, 1.5);
  const out = [];
  for (let i = 0; i < vertices.length; i += 3)
    for (let k = 0; k < 3; ++k)
      out.push(size * rows[k].reduce((sum, m, j) => sum + m * vertices[i + j], 0) + shift[k]);
  return { vertices: out, faces };
}

const smooth = [torus, ball, () => box([-0.7, -0.7, -0.7], [0.7, 0.7, 0.7])];
const lattice = [latticeBox, latticeTetrahedron];

export const operations = ['union', 'intersection', 'difference', 'xor'];

/** Two to five operands, points, and the rows of a pose. */
export function randomCase(random) {
  const onLattice = random.index(2) === 0;
  const operands = Array.from({ length: 2 + random.index(4) }, () => {
    const shapes = onLattice ? lattice : smooth;
    const mesh = shapes[random.index(shapes.length)](random);
    const { vertices, faces } = onLattice ? mesh : moved(mesh, random);
    return { vertices: Float64Array.from(vertices), faces: Uint32Array.from(faces) };
  });
  const coordinate = () => (onLattice ? random.index(13) / 2 : random.between(-2, 2));
  const points = Float64Array.from({ length: 60 }, coordinate);
  const by = () => (onLattice ? random.index(5) - 2 : random.between(-1, 1));
  const rows = Float64Array.of(1, 0, 0, by(), 0, 1, 0, by(), 0, 0, 1, by());
  return { operation: random.index(4), operands, points, rows };
}
