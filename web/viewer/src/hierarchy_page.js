// SPDX-License-Identifier: Apache-2.0
//
// Volumes of structures around two solids, level by level, while one of them moves; and what each
// structure does meanwhile.

import { element } from './parts.js';
import { palette, darkness } from './picture.js';
import { boxRegion, endsOf, partOf } from './region.js';
import { StagePage } from './stage_page.js';

const sizes = { balls: 4, boxes: 12 };

/** Numbers of volumes to ends of segments. */
function endsOfBox(n) {
  const corner = (c) =>
    [0, 1, 2].map((k) => n[k] + [0, 1, 2].reduce((s, i) => s + ((c >> i) & 1 ? 1 : -1) * n[3 + 3 * i + k], 0));
  const out = [];
  for (let c = 0; c < 8; ++c)
    for (let i = 0; i < 3; ++i) if (!((c >> i) & 1)) out.push(corner(c), corner(c | (1 << i)));
  return out;
}
function endsOfBall(n) {
  const out = [];
  const steps = 24;
  for (let axis = 0; axis < 3; ++axis)
    for (let i = 0; i < steps; ++i)
      for (const j of [i, i + 1]) {
        const p = [n[0], n[1], n[2]];
        p[(axis + 1) % 3] += n[3] * Math.cos((2 * Math.PI * j) / steps);
        p[(axis + 2) % 3] += n[3] * Math.sin((2 * Math.PI * j) / steps);
        out.push(p);
      }
  return out;
}
// The first three slabs are along the axes.
function endsOfSlabs(n, directions) {
  let region = boxRegion([n[0], n[2], n[4]], [n[1], n[3], n[5]]);
  for (let i = 3; i < directions.length; ++i) {
    region = partOf(region, { normal: directions[i], offset: n[2 * i] }, 1);
    region = partOf(region, { normal: directions[i], offset: n[2 * i + 1] }, -1);
  }
  return endsOf(region.polygons);
}

class Volumes {
  constructor(facts, arrays, number) {
    this.facts = facts;
    this.size = sizes[facts.volumes] ?? 2 * (facts.directions?.length ?? 0);
    const floats = (name) => {
      const bytes = arrays.bytes(name);
      return new Float32Array(bytes.slice().buffer);
    };
    this.a = floats(`volumes_a${number}`);
    this.b = floats(`volumes_b${number}`);
  }

  /** Ends of all volumes of a level; leaves above it stand for what is below them. */
  ends(ofB, frame, level) {
    const levels = ofB ? this.facts.levels_b : this.facts.levels_a;
    const all = ofB ? this.b : this.a;
    const first = ofB ? frame * levels.length : 0;
    const out = [];
    let count = 0;
    levels.forEach((code, i) => {
      const at = code >> 1;
      if (at !== level && !(at < level && code & 1)) return;
      const n = all.subarray(this.size * (first + i), this.size * (first + i + 1));
      ++count;
      const kind = this.facts.volumes;
      for (const p of kind === 'balls' ? endsOfBall(n)
        : kind === 'boxes' ? endsOfBox(n)
        : endsOfSlabs(n, this.facts.directions)) out.push(p);
    });
    return { ends: out, count };
  }
}

export class HierarchyPage extends StagePage {
  extend() {
    const { structures } = this.facts;
    this.volumes = structures.map((s, i) => (s.volumes ? new Volumes(s, this.arrays, i) : null));
    const dark = darkness.matches;
    this.lineA = this.stage.addLine(dark ? palette[0] : '#0a5f8f', 2);
    this.lineB = this.stage.addLine(dark ? palette[1] : '#9a5800', 2);
    for (const line of [this.lineA, this.lineB]) line.material.depthTest = true;
    this.chart = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
    this.chart.setAttribute('class', 'chart');
    this.chart.setAttribute('role', 'img');
    this.slider = element('input', {
      type: 'range', min: 0, max: 4, value: 3, 'aria-label': 'level',
      oninput: () => this.showVolumes(),
    });
    this.levelText = element('div', { id: 'level-text', role: 'status' });
    this.panel.append(
      element('h2', {}, 'structures'),
      this.costTable(),
      element('label', {}, 'level', this.slider),
      this.levelText,
      this.chart,
    );
    const first = structures.findIndex((s) => s.name === 'obb');
    this.use(first >= 0 ? first : 0);
  }

  // F = Nu Cu + Nbv Cbv + Np Cp, counted over the frames of the page and predicted for all.
  costTable() {
    const sums = this.facts.structures.map((s) =>
      [0, 1, 2].map((k) => s.counts.reduce((sum, c) => sum + c[k], 0)),
    );
    const number = (n) => (n < 1e5 ? String(n) : n.toExponential(1));
    const ms = (s) => (s === undefined ? '' : (1000 * s).toPrecision(2));
    this.rows = this.facts.structures.map((s, i) =>
      element(
        'tr',
        { tabIndex: 0, onclick: () => this.use(i), onkeydown: (e) => this.rowKey(e, i) },
        ...[s.name, ...sums[i].map(number), ms(s.predicted), ms(s.measured)].map((t) => element('td', {}, t)),
      ),
    );
    const box = element(
      'div',
      { className: 'bodies' },
      element(
        'table',
        { className: 'costs' },
        element(
          'tr',
          {},
          ...[
            ['', ''], ['Nu', 'volumes updated'], ['Nbv', 'pairs of volumes compared'],
            ['Np', 'pairs of triangles compared'], ['F', 'milliseconds that the cost function predicts'],
            ['t', 'milliseconds measured'],
          ].map(([t, title]) => element('th', { title }, t)),
        ),
        ...this.rows,
      ),
    );
    box.style.maxHeight = '30vh';
    return box;
  }
  rowKey(e, i) {
    const by = { ArrowDown: 1, ArrowUp: -1, Enter: 0 }[e.key];
    if (by === undefined) return;
    e.preventDefault();
    e.stopPropagation();
    const next = Math.min(this.rows.length - 1, Math.max(0, i + by));
    this.rows[next].focus();
    this.use(next);
  }

  keyWords() {
    return '[ and ] levels, S the next structure. ';
  }
  keys() {
    const level = (by) => {
      this.slider.value = Number(this.slider.value) + by;
      this.showVolumes();
    };
    return {
      '[': () => level(-1),
      ']': () => level(1),
      s: () => this.use((this.structure + 1) % this.rows.length),
    };
  }

  use(i) {
    this.structure = i;
    this.rows.forEach((row, k) => row.setAttribute('aria-selected', String(k === i)));
    this.drawChart();
    this.showVolumes();
  }
  frameChanged() {
    this.drawChart();
    this.showVolumes();
  }

  showVolumes() {
    const volumes = this.volumes[this.structure];
    const { name } = this.facts.structures[this.structure];
    const level = Number(this.slider.value);
    const frame = this.timeline?.frame ?? 0;
    const local = (points) => points.flatMap((p) => this.stage.local(p));
    if (!volumes) {
      this.stage.setLine(this.lineA, []);
      this.stage.setLine(this.lineB, []);
      this.levelText.textContent = `${name} has no volumes to be drawn`;
      this.shown = { structure: name, a: 0, b: 0 };
      return this.stage.draw();
    }
    const a = volumes.ends(false, 0, level);
    const b = volumes.ends(true, frame, level);
    this.stage.setLine(this.lineA, local(a.ends));
    this.stage.setLine(this.lineB, local(b.ends));
    this.shown = { structure: name, a: a.count, b: b.count };
    this.levelText.textContent = volumes.facts.levels_b.length > 0
      ? `${name}, level ${level}: ${a.count} and ${b.count} volumes`
      : `${name}, level ${level}: ${a.count} cells, all of the solid at rest`;
    return this.stage.draw();
  }

  // Pairs of volumes and of triangles, frame by frame.
  drawChart() {
    const { counts, name } = this.facts.structures[this.structure];
    const [w, h] = [280, 64];
    const most = Math.max(1, ...counts.map((c) => Math.max(c[1], c[2])));
    const x = (i) => (w * i) / Math.max(1, counts.length - 1);
    const line = (k) =>
      counts.map((c, i) => `${x(i).toFixed(1)},${(h - 2 - ((h - 14) * c[k]) / most).toFixed(1)}`).join(' ');
    const frame = this.timeline?.frame ?? 0;
    const now = counts[frame] ?? [0, 0, 0];
    this.chart.setAttribute('viewBox', `0 0 ${w} ${h}`);
    this.chart.setAttribute('preserveAspectRatio', 'none');
    this.chart.setAttribute('aria-label', `${name}: ${now[1]} pairs of volumes, ${now[2]} of triangles in this frame`);
    const ink = 'var(--ink)';
    this.chart.innerHTML =
      `<polyline points="${line(1)}" fill="none" stroke="var(--mark)" stroke-width="2"/>` +
      `<polyline points="${line(2)}" fill="none" stroke="var(--alarm)" stroke-width="2" stroke-dasharray="5 3"/>` +
      `<line x1="${x(frame)}" x2="${x(frame)}" y1="0" y2="${h}" stroke="${ink}" stroke-width="1"/>`;
    if (!this.chartText) {
      this.chartText = element('div', { id: 'counts' });
      this.chart.after(this.chartText);
    }
    this.chartText.textContent =
      `this frame: ${now[1]} pairs of volumes (line), ${now[2]} of triangles (dashed)`;
  }

  driver() {
    return {
      ...super.driver(),
      show: (name, level, frame) => {
        this.use(this.facts.structures.findIndex((s) => s.name === name));
        this.slider.value = level;
        this.timeline.seek(frame);
      },
    };
  }
  async report(question) {
    const out = await super.report(question);
    out.structures = this.facts.structures.map((s, i) => {
      this.use(i);
      this.slider.value = question.level ?? 0;
      this.timeline.seek(question.at ?? 0);
      const volumes = this.volumes[i];
      return {
        ...this.shown,
        counts: s.counts[this.timeline.frame],
        ends_b: volumes ? volumes.ends(true, this.timeline.frame, question.level ?? 0).ends : [],
      };
    });
    return out;
  }
}
