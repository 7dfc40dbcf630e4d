// SPDX-License-Identifier: Apache-2.0
//
// A page of bodies: what is pointed at, findings to go through, a motion to be played.

import { ChoiceList, Timeline, byId, element } from './parts.js';
import { palette, randomNumbers } from './picture.js';
import { Stage, colorOfKind, placed } from './stage.js';

const kindWords = { error: '●', warning: '▲', note: '■' };

export class StagePage {
  constructor(facts, arrays) {
    this.facts = facts;
    this.arrays = arrays;
    this.stage = new Stage(byId('view'), facts, arrays);
    this.panel = byId('panel');
    this.text = element('div', { id: 'finding', role: 'status' });
    this.details = element('pre', { id: 'picked', 'aria-live': 'polite' });
    this.picked = null;
    this.showHead();
    this.showBodies();
    this.extend();
    this.showFindings();
    this.showKeys();
    this.showTimeline();
    this.listen();
    this.refresh();
  }

  /** For pages that have more in their panel. */
  extend() {}
  keys() {
    return {};
  }
  keyWords() {
    return '';
  }

  showHead() {
    this.panel.append(
      element('h1', { id: 'name' }, this.facts.title),
      element('div', { id: 'summary' }, ...this.facts.summary.map((s) => element('div', {}, s))),
    );
  }

  showBodies() {
    const list = element('ul', { className: 'bodies', id: 'legend' });
    this.selects = this.stage.bodies.map((body) => {
      const dot = element('i');
      dot.style.background = palette[body.facts.color % palette.length];
      const select = element(
        'select',
        { 'aria-label': `how ${body.name} is shown`, onchange: () => this.stage.setLook(body, select.value) },
        ...['solid', 'clear', 'hidden'].map((look) => element('option', { value: look }, look)),
      );
      select.value = body.look;
      list.append(element('li', {}, element('label', {}, dot, element('span', {}, body.name), select)));
      return select;
    });
    this.panel.append(
      list,
      element(
        'label',
        {},
        element('input', {
          type: 'checkbox', id: 'edges', checked: this.hasFewEdges(),
          onchange: (e) => this.stage.showEdges(e.target.checked),
        }),
        'edges',
      ),
    );
    if (!this.hasFewEdges()) this.stage.showEdges(false);
  }
  // Of very many only a grey veil would be seen.
  hasFewEdges() {
    return this.stage.bodies.every((b) => b.shape.edges.length < 2 * this.mostEdges());
  }
  mostEdges() {
    return 30000;
  }

  showFindings() {
    const { findings } = this.facts;
    if (findings.length) {
      this.list = new ChoiceList(
        'findings',
        'what was found',
        findings.map((f) => {
          const sign = element('b', { 'aria-hidden': 'true' }, kindWords[f.kind]);
          sign.style.color = colorOfKind(f.kind);
          return [sign, f.title];
        }),
        (i) => this.choose(i),
      );
      const more = this.facts.more_findings;
      this.panel.append(
        element('h2', {}, `${findings.length}${more ? ` of ${findings.length + more}` : ''} found`),
        this.list.element,
        this.text,
      );
    }
    this.panel.append(this.details);
  }

  showKeys() {
    this.panel.append(
      element(
        'details',
        {},
        element('summary', {}, 'keys'),
        'drag: turn; wheel: nearer; right button: move; in the picture arrows turn, + and - zoom. ' +
          'E edges, G clear or solid, R all from the front, ' +
          (this.facts.findings.length ? 'N and P the next finding and the one before, ' : '') +
          (this.facts.timeline ? 'space play, comma and dot a moment back and on, C the contact, ' : '') +
          this.keyWords() +
          'Escape forget.',
      ),
    );
  }

  showTimeline() {
    if (!this.facts.timeline) return;
    this.timeline = new Timeline(this.facts.timeline, (frame) => {
      this.stage.setFrame(frame);
      this.frameChanged(frame);
      this.refresh();
    });
    byId('bar').append(...this.timeline.elements);
    this.timeline.seek(0);
  }
  frameChanged() {}

  /** Findings that are there at this moment. */
  refresh() {
    const frame = this.timeline?.frame;
    this.stage.showFindings(
      this.facts.findings.filter((f) => f.frame === undefined || f.frame === frame),
    );
    const chosen = this.facts.findings[this.list?.index];
    if (chosen?.frame !== undefined) this.stage.choose(chosen.frame === frame ? chosen : null);
  }

  choose(i) {
    const finding = this.facts.findings[i];
    this.text.textContent = finding?.text ?? '';
    if (finding?.frame !== undefined && this.timeline) {
      this.timeline.pause();
      this.timeline.seek(finding.frame);
    }
    this.stage.choose(finding ?? null);
    this.emphasize(finding?.bodies);
    if (!finding) return;
    const where = this.stage.placeOf(finding);
    if (where) this.stage.flyTo(where.place, this.reachOf(finding, where.reach));
  }

  // A point has no extent: some of what is around it is shown, at most of the smaller body.
  reachOf(finding, reach) {
    const bodies = new Set([...(finding.bodies ?? []), ...(finding.faces ?? []).map(([b]) => b)]);
    let around = this.stage.size / 4;
    for (const b of bodies) {
      const { low, high } = this.stage.bodies[b].shape;
      around = Math.min(around, 0.8 * Math.hypot(...high.map((h, k) => h - low[k])));
    }
    return Math.max(reach, around);
  }

  /** Shows all bodies but these as faint; as they were, where none are given. */
  emphasize(bodies) {
    this.stage.bodies.forEach((body, b) => {
      const chosen = this.selects[b].value;
      const look = !bodies || chosen === 'hidden' ? chosen : bodies.includes(b) ? 'clear' : 'faint';
      if (body.look !== look) this.stage.setLook(body, look);
    });
  }

  forget() {
    this.picked = null;
    this.details.textContent = '';
    this.stage.highlight(null);
    this.list?.select(-1);
  }

  listen() {
    const canvas = byId('view');
    new ResizeObserver(() => this.stage.resize()).observe(canvas);
    canvas.addEventListener('pointermove', (e) => {
      if (e.buttons !== 0) return;
      const item = this.stage.pick(e.offsetX, e.offsetY);
      this.stage.highlight(item);
      byId('item').textContent = item ? this.name(item) : '';
    });
    let down = null;
    canvas.addEventListener('pointerdown', (e) => (down = [e.offsetX, e.offsetY]));
    canvas.addEventListener('pointerup', (e) => {
      if (!down || Math.hypot(e.offsetX - down[0], e.offsetY - down[1]) >= 4) return;
      const item = this.stage.pick(e.offsetX, e.offsetY);
      if (item) this.show(item);
      else this.forget();
    });
    document.addEventListener('keydown', (e) => this.key(e));
  }

  key(e) {
    if (e.ctrlKey || e.metaKey || e.altKey || /^(INPUT|SELECT|TEXTAREA)$/.test(e.target.tagName)) {
      if (!(e.key === 'Escape')) return;
    }
    const actions = {
      e: () => byId('edges').click(),
      g: () => this.toggleClear(),
      r: () => this.stage.lookFrom([1, -1.3, 0.9]),
      n: () => this.list?.step(1),
      p: () => this.list?.step(-1),
      Escape: () => this.forget(),
      ...(this.timeline && {
        ' ': () => this.timeline.toggle(),
        ',': () => this.timeline.seek(this.timeline.frame - 1),
        '.': () => this.timeline.seek(this.timeline.frame + 1),
        c: () => this.timeline.toContact.click(),
      }),
      ...this.keys(),
    };
    if (!actions[e.key] || (e.key === ' ' && e.target.tagName === 'BUTTON')) return;
    e.preventDefault();
    actions[e.key]();
  }

  toggleClear() {
    const solid = this.stage.bodies.some((b) => b.look === 'solid');
    this.stage.bodies.forEach((body, b) => {
      if (body.look === 'hidden') return;
      this.selects[b].value = solid ? 'clear' : 'solid';
      this.stage.setLook(body, this.selects[b].value);
    });
  }

  show(item) {
    this.picked = item;
    this.details.textContent = this.describe(item);
  }

  name(item) {
    return `${item.kind} ${item.number} of ${this.stage.bodies[item.body].name}`;
  }
  describe(item) {
    const { shape, pose } = this.stage.bodies[item.body];
    const lines = [this.name(item)];
    const point = (p) => `(${p.map(String).join(', ')})`;
    if (item.kind === 'face' && shape.source.length)
      lines.push(`face ${shape.source[item.number]} of its file`);
    const ends =
      item.kind === 'vertex' ? [item.number]
      : item.kind === 'edge' ? [shape.edges[2 * item.number], shape.edges[2 * item.number + 1]]
      : [];
    for (const v of ends) {
      lines.push(`${item.kind === 'edge' ? `vertex ${v} ` : ''}${point(shape.point(v))}`);
      if (pose.some((x, i) => x !== [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0][i]))
        lines.push(`  now at ~${point(placed(pose, shape.point(v)))}`);
    }
    this.facts.findings.forEach((f, i) => {
      if ((f.faces ?? []).some(([b, face]) => b === item.body && face === item.face))
        lines.push(`found here: ${i + 1}. ${f.title}`);
    });
    return lines.slice(0, 24).join('\n');
  }

  // --- For programs ---

  driver() {
    const page = this;
    return {
      page,
      pick: (x, y) => page.stage.pick(x, y),
      describe: (item) => page.describe(item),
      find: (i) => page.list.select(i),
      play: () => page.timeline.start(),
      seek: (frame) => page.timeline.seek(frame),
      state: () => page.state(),
      samples: (count, seed) => page.samples(count, seed),
      report: (question) => page.report(question),
    };
  }

  state() {
    const { timeline } = this.facts;
    return {
      frame: this.timeline?.frame,
      time: timeline?.times[this.timeline.frame],
      contact: timeline?.contact,
      text: this.timeline?.text.textContent,
      poses: this.stage.bodies.map((b) => [...b.pose]),
      chosen: this.list?.index,
    };
  }

  /** Rays through random pixels, and the body and face that is hit. */
  samples(count, seed) {
    const random = randomNumbers(seed);
    const { stage } = this;
    const { clientWidth: w, clientHeight: h } = stage.renderer.domElement;
    const out = [];
    for (let i = 0; i < 60 * count && out.length < count; ++i) {
      const x = random() * w;
      const y = random() * h;
      const item = stage.pick(x, y, 0);
      if (!item) continue;
      const ndc = [(2 * x) / w - 1, 1 - (2 * y) / h];
      const { camera, middle } = stage;
      const v = camera.position.clone().set(ndc[0], ndc[1], 0.5).unproject(camera);
      out.push({
        eye: camera.position.toArray().map((c, k) => c + middle[k]),
        to: v.toArray().map((c, k) => c + middle[k]),
        body: item.body,
        face: item.face,
        name: this.name({ ...item, kind: 'face', number: item.face }),
        corners: [0, 1, 2].map((k) => {
          const { shape, pose } = stage.bodies[item.body];
          return placed(pose, shape.point(shape.triangles[3 * item.triangle + k]));
        }),
      });
    }
    return out;
  }

  /** All that a test asks of the page. */
  async report({ picks = 0, seed = 1, play = 0, frames = [], findings = [] }) {
    const out = { start: performance.now() };
    for (const body of this.stage.bodies)
      if (picks && body.look !== 'hidden') this.stage.setLook(body, 'solid');
    out.picks = this.samples(picks, seed);
    if (play) {
      this.timeline.seconds = play;
      await this.timeline.start();
      out.stopped = this.state();
    }
    out.frames = frames.map((f) => {
      this.timeline.seek(f);
      return this.state();
    });
    out.findings = findings.map((i) => {
      this.list.select(i);
      return { text: this.text.textContent, frame: this.timeline?.frame ?? null };
    });
    out.names = this.facts.bodies.map((b) => b.name);
    out.count = this.facts.findings.length;
    return out;
  }
}
