// SPDX-License-Identifier: Apache-2.0
//
// Exact numbers, points and planes: fractions of big integers.

const abs = (a) => (a < 0n ? -a : a);

function gcd(a, b) {
  a = abs(a);
  b = abs(b);
  while (b !== 0n) [a, b] = [b, a % b];
  return a;
}

/** A fraction n / d in lowest terms, d > 0. */
export class Fraction {
  constructor(n, d = 1n) {
    if (d < 0n) [n, d] = [-n, -d];
    const g = d === 1n ? 1n : gcd(n, d);
    this.n = g > 1n ? n / g : n;
    this.d = g > 1n ? d / g : d;
  }

  /** The double, exactly. */
  static of(x) {
    if (x === 0) return new Fraction(0n);
    const view = new DataView(new ArrayBuffer(8));
    view.setFloat64(0, x);
    const bits = view.getBigUint64(0);
    const biased = Number((bits >> 52n) & 0x7ffn);
    const m = (bits & 0xfffffffffffffn) | (biased === 0 ? 0n : 1n << 52n);
    const exponent = Math.max(biased, 1) - 1075;
    const n = bits >> 63n ? -m : m;
    return exponent >= 0
      ? new Fraction(n << BigInt(exponent))
      : new Fraction(n, 1n << BigInt(-exponent));
  }

  plus(o) {
    return new Fraction(this.n * o.d + o.n * this.d, this.d * o.d);
  }
  minus(o) {
    return new Fraction(this.n * o.d - o.n * this.d, this.d * o.d);
  }
  times(o) {
    return new Fraction(this.n * o.n, this.d * o.d);
  }
  over(o) {
    return new Fraction(this.n * o.d, this.d * o.n);
  }
  sign() {
    return this.n > 0n ? 1 : this.n < 0n ? -1 : 0;
  }
  compare(o) {
    return this.minus(o).sign();
  }

  /** Near the value, to a few units in the last place. */
  toNumber() {
    const bits = (v) => abs(v).toString(2).length;
    const shift = bits(this.d) - bits(this.n) + 64;
    const q = shift >= 0 ? (this.n << BigInt(shift)) / this.d : this.n / (this.d << BigInt(-shift));
    let out = Number(q);
    for (let s = shift; s !== 0; ) {
      const step = Math.max(-900, Math.min(900, s));
      out /= 2 ** step;
      s -= step;
    }
    return out;
  }

  /** A decimal number where it ends, else a fraction; `~` and a rounded one where both are long. */
  toString(longest = 60) {
    let d = this.d;
    let twos = 0;
    let fives = 0;
    while (d % 2n === 0n) {
      d /= 2n;
      ++twos;
    }
    while (d % 5n === 0n) {
      d /= 5n;
      ++fives;
    }
    let out = `${this.n}/${this.d}`;
    if (d === 1n) {
      const places = Math.max(twos, fives);
      const digits = abs((this.n * 10n ** BigInt(places)) / this.d)
        .toString()
        .padStart(places + 1, '0');
      const whole = digits.slice(0, digits.length - places);
      out = (this.n < 0n ? '-' : '') + whole + (places ? '.' + digits.slice(-places) : '');
    }
    return out.length <= longest ? out : `~${this.toNumber()}`;
  }
}

const zero = new Fraction(0n);

export const vector = {
  of: (p) => p.map((x) => Fraction.of(x)),
  minus: (a, b) => a.map((x, k) => x.minus(b[k])),
  plus: (a, b) => a.map((x, k) => x.plus(b[k])),
  times: (a, s) => a.map((x) => x.times(s)),
  dot: (a, b) => a.reduce((sum, x, k) => sum.plus(x.times(b[k])), zero),
  cross: (a, b) =>
    [0, 1, 2].map((k) => {
      const i = (k + 1) % 3;
      const j = (k + 2) % 3;
      return a[i].times(b[j]).minus(a[j].times(b[i]));
    }),
  isZero: (a) => a.every((x) => x.sign() === 0),
};

/** The points x with normal · x = offset. */
export class Plane {
  constructor(normal, offset) {
    this.normal = normal;
    this.offset = offset;
  }

  /** Nothing where the points lie on a line. */
  static through(a, b, c) {
    const n = vector.cross(vector.minus(b, a), vector.minus(c, a));
    return vector.isZero(n) ? null : new Plane(n, vector.dot(n, a)).inLowestTerms();
  }

  /** With whole coefficients that have no common divisor. */
  inLowestTerms() {
    const all = [...this.normal, this.offset];
    let d = 1n;
    for (const x of all) d = (d / gcd(d, x.d)) * x.d;
    let g = 0n;
    for (const x of all) g = gcd(g, x.n * (d / x.d));
    const scaled = all.map((x) => new Fraction((x.n * (d / x.d)) / g));
    return new Plane(scaled.slice(0, 3), scaled[3]);
  }

  value(p) {
    return vector.dot(this.normal, p).minus(this.offset);
  }

  toString() {
    const names = ['x', 'y', 'z'];
    let out = '';
    for (let k = 0; k < 3; ++k) {
      const v = this.normal[k];
      if (v.sign() === 0) continue;
      const size = abs(v.n) === 1n && v.d === 1n ? '' : new Fraction(abs(v.n), v.d).toString() + ' ';
      out += (v.sign() < 0 ? (out ? ' - ' : '-') : out ? ' + ' : '') + size + names[k];
    }
    return `${out} = ${this.offset}`;
  }
}

/** The common point of three planes; nothing where there is none or more than one. */
export function common(p, q, r) {
  const qr = vector.cross(q.normal, r.normal);
  const det = vector.dot(p.normal, qr);
  if (det.sign() === 0) return null;
  const rp = vector.cross(r.normal, p.normal);
  const pq = vector.cross(p.normal, q.normal);
  return vector
    .plus(
      vector.plus(vector.times(qr, p.offset), vector.times(rp, q.offset)),
      vector.times(pq, r.offset),
    )
    .map((x) => x.over(det));
}
