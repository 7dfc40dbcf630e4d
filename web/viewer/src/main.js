// SPDX-License-Identifier: Apache-2.0
//
// The page: panel, mouse and keys. `window.trisect` is for programs that drive it.

import { measure } from './measure.js';
import { Arrays, Model } from './model.js';
import { HierarchyPage } from './hierarchy_page.js';
import { palette, randomNumbers } from './picture.js';
import { byId } from './parts.js';
import { Scene } from './scene.js';
import { areaOf, sectionLoops } from './section.js';
import { StagePage } from './stage_page.js';
import { TreePage } from './tree_page.js';

const axes = ['x', 'y', 'z'];

class Page {
  constructor(facts, model, scene) {
    this.facts = facts;
    this.model = model;
    this.scene = scene;
    this.axis = -1;
    this.at = 0;
    this.picked = [];
    this.fillPanel();
    this.listen();
  }

  fillPanel() {
    const { facts, model } = this;
    byId('name').textContent = facts.title;
    byId('counts').textContent =
      `${model.faceCount} faces, ${model.edgeCount} edges, ${model.vertexCount} vertices, ` +
      `${model.shellCount} ${model.shellCount === 1 ? 'shell' : 'shells'}, volume ${facts.volume}`;
    const legend = byId('legend');
    facts.operands.forEach((name, i) => {
      const item = document.createElement('li');
      const dot = document.createElement('i');
      dot.style.background = palette[i % palette.length];
      item.append(dot, name);
      legend.append(item);
    });
    byId('ghosts').disabled = !this.scene.ghosts;
    byId('explode').disabled = model.shellCount < 2;
  }

  listen() {
    const canvas = byId('view');
    new ResizeObserver(() => this.scene.resize()).observe(canvas);
    canvas.addEventListener('pointermove', (e) => {
      if (e.buttons === 0) this.hover(e.offsetX, e.offsetY);
    });
    let down = null;
    canvas.addEventListener('pointerdown', (e) => (down = [e.offsetX, e.offsetY]));
    canvas.addEventListener('pointerup', (e) => {
      if (down && Math.hypot(e.offsetX - down[0], e.offsetY - down[1]) < 4)
        this.click(e.offsetX, e.offsetY);
    });
    byId('edges').addEventListener('change', (e) => {
      this.scene.edges.visible = e.target.checked;
      this.scene.draw();
    });
    byId('ghosts').addEventListener('change', (e) => {
      this.scene.ghosts.visible = e.target.checked;
      this.scene.draw();
    });
    byId('axis').addEventListener('change', (e) => this.cut(Number(e.target.value)));
    byId('level').addEventListener('input', () => this.cut(this.axis));
    byId('explode').addEventListener('input', (e) => this.scene.explode(Number(e.target.value)));
    document.addEventListener('keydown', (e) => this.key(e));
  }

  key(e) {
    const toggle = (id) => byId(id).disabled || byId(id).click();
    const level = byId('level');
    const step = (by) => {
      level.value = Number(level.value) + by;
      this.cut(this.axis);
    };
    const actions = {
      e: () => toggle('edges'),
      g: () => toggle('ghosts'),
      s: () => this.cut(this.axis === 2 ? -1 : this.axis + 1),
      '[': () => step(-5),
      ']': () => step(5),
      r: () => this.scene.lookFrom([1, -1.3, 0.9]),
      n: () => this.step(1),
      p: () => this.step(-1),
      Escape: () => this.forget(),
    };
    if (!e.ctrlKey && !e.metaKey && !e.altKey && actions[e.key]) actions[e.key]();
  }

  /** A section across an axis, at the slider's level; -1 for none. */
  cut(axis, at) {
    this.axis = axis;
    byId('axis').value = axis;
    byId('level').disabled = axis < 0;
    if (axis < 0) {
      byId('section').textContent = '';
      this.scene.cut(-1);
      return [];
    }
    const { low, high } = this.model;
    this.at = at ?? low[axis] + ((high[axis] - low[axis]) * Number(byId('level').value)) / 1000;
    const loops = sectionLoops(this.model, axis, this.at);
    byId('section').textContent =
      `${axes[axis]} = ${this.at}: ${loops.length} ${loops.length === 1 ? 'loop' : 'loops'}, ` +
      `area ${areaOf(loops, axis).toPrecision(9)}`;
    this.scene.cut(axis, this.at, loops);
    return loops;
  }

  hover(x, y) {
    const item = this.scene.pick(x, y);
    this.scene.highlight(item);
    byId('item').textContent = item ? this.name(item) : '';
  }

  click(x, y) {
    const item = this.scene.pick(x, y);
    if (!item) return this.forget();
    this.picked = [...this.picked.slice(-1), item];
    this.show();
  }

  /** The next face, for those who do not point. */
  step(by) {
    const last = this.picked.at(-1);
    const from = last?.kind === 'face' ? last.number : by > 0 ? -1 : 0;
    const number = (from + by + this.model.faceCount) % this.model.faceCount;
    const item = { kind: 'face', number, face: number };
    this.picked = [item];
    this.scene.highlight(item);
    this.show();
  }

  forget() {
    this.picked = [];
    this.scene.highlight(null);
    this.show();
  }

  show() {
    byId('picked').textContent = this.picked.map((i) => this.describe(i)).join('\n\n');
    byId('distance').textContent = '';
    if (this.picked.length < 2) return;
    const found = measure(this.model, ...this.picked);
    byId('distance').textContent = found
      ? `distance ${found.distance}, its square ${found.rounded ? '~' : ''}${found.square}`
      : 'faces of too many triangles to be measured here';
  }

  operandName(face) {
    const operand = this.model.faceOperand[face];
    return this.facts.operands[operand] ?? `operand ${operand}`;
  }

  name(item) {
    const of = item.kind === 'face' ? ` of ${this.operandName(item.number)}` : '';
    return `${item.kind} ${item.number}${of}`;
  }

  /** All that is known of it, exactly. */
  describe(item) {
    const m = this.model;
    if (item.kind === 'vertex') {
      const rounded = m.precision(item.number) === 'rounded' ? '~' : '';
      const p = m.exactPoint(item.number).map(String);
      return `vertex ${item.number}\n${rounded}(${p.join(', ')})\nfaces ${m.facesAt(item.number).join(', ')}`;
    }
    if (item.kind === 'edge') {
      const [a, b] = [m.edges[2 * item.number], m.edges[2 * item.number + 1]];
      const shared = m.facesAt(a).filter((f) => m.facesAt(b).includes(f));
      return `edge ${item.number}\nvertices ${a}, ${b}\nfaces ${shared.join(', ')}`;
    }
    const f = item.number;
    return (
      `face ${f}\nface ${m.faceSource[f]} of ${this.operandName(f)}\n${m.plane(f)}`
    );
  }
}

/** What a program asks of the page: picks at many pixels, sections. */
function driver(page) {
  return {
    page,
    pick: (x, y) => page.scene.pick(x, y),
    describe: (item) => page.describe(item),
    section: (axis, at) => page.cut(axis, at),
    measure: (a, b) => String(measure(page.model, a, b)?.square),
    exactPoint: (v) => page.model.exactPoint(v).map((x) => `${x.n}/${x.d}`),
    /** Rays through random pixels and what is hit: face, and where. */
    samples: (count, seed) => {
      const random = randomNumbers(seed);
      const { scene, model } = page;
      const { clientWidth: w, clientHeight: h } = scene.renderer.domElement;
      const out = [];
      for (let i = 0; i < 40 * count && out.length < count; ++i) {
        const x = random() * w;
        const y = random() * h;
        const item = scene.pick(x, y, 0);
        if (!item) continue;
        const ndc = [(2 * x) / w - 1, 1 - (2 * y) / h];
        const v = scene.camera.position.clone().set(ndc[0], ndc[1], 0.5).unproject(scene.camera);
        const eye = scene.camera.position.toArray().map((c, k) => c + scene.middle[k]);
        const to = v.toArray().map((c, k) => c + scene.middle[k]);
        const plane = model.plane(item.face);
        const exact = [...plane.normal, plane.offset].map((c) => `${c.n}/${c.d}`);
        const corners = [0, 1, 2].map((k) => model.point(model.triangles[3 * item.triangle + k]));
        out.push({ eye, to, face: item.face, plane: exact, corners });
      }
      return out;
    },
    /** Numbers of the picture that a mark changes, and that are others after it has gone. */
    markChanges(vertex) {
      const { scene } = page;
      const gl = scene.renderer.getContext();
      const pixels = () => {
        const out = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
        gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, out);
        return out;
      };
      const show = (item) => {
        scene.highlight(item);
        scene.drawOverNow();
        return pixels();
      };
      const before = show(null);
      const differing = (other) => other.reduce((sum, x, i) => sum + (x !== before[i]), 0);
      const out = { there: differing(show({ kind: 'vertex', number: vertex })) };
      return { ...out, gone: differing(show(null)) };
    },
    /** All that a test compares with the engine. */
    report({ picks, seed, sections, vertices }) {
      return {
        picks: this.samples(picks, seed),
        marks: this.markChanges(page.model.triangles[0]),
        sections: sections.map(([axis, at]) => {
          const loops = page.cut(axis, at);
          return { loops: loops.length, corners: loops.flat().length, area: areaOf(loops, axis) };
        }),
        vertices: vertices.map((v) => ({
          number: v % page.model.vertexCount,
          rounded: page.model.point(v % page.model.vertexCount),
          precision: page.model.precision(v % page.model.vertexCount),
          exact: this.exactPoint(v % page.model.vertexCount),
        })),
      };
    },
  };
}

function solidPage(facts, arrays) {
  const model = new Model(facts, arrays);
  const scene = new Scene(byId('view'), model);
  const inputs = Array.from({ length: facts.inputs }, (_, i) => ({
    points: arrays.doubles(`points${i}`),
    triangles: arrays.integers(`triangles${i}`),
  }));
  if (inputs.length) scene.addGhosts(inputs);
  const page = new Page(facts, model, scene);
  scene.resize();
  scene.drawNow();
  return driver(page);
}

function stagePage(Kind, facts, arrays) {
  const page = new Kind(facts, arrays);
  page.stage.resize();
  page.stage.drawNow();
  return page.driver();
}

const pages = {
  scene: (facts, arrays) => stagePage(StagePage, facts, arrays),
  tree: (facts, arrays) => stagePage(TreePage, facts, arrays),
  hierarchies: (facts, arrays) => stagePage(HierarchyPage, facts, arrays),
};

async function start() {
  const facts = JSON.parse(byId('facts').textContent);
  const arrays = await Arrays.read(byId('data').textContent.trim(), facts.places);
  window.trisect = (pages[facts.page] ?? solidPage)(facts, arrays);
  // For programs that can only read the document: #call=FUNCTION&with=[ARGUMENTS] of the driver.
  const wanted = new URLSearchParams(location.hash.slice(1));
  const call = wanted.get('call');
  if (call && Object.hasOwn(window.trisect, call) && call !== 'page')
    byId('answer').textContent = JSON.stringify(
      (await window.trisect[call](...JSON.parse(wanted.get('with') ?? '[]'))) ?? null,
    );
  document.title = `${facts.title}: ready`;
}

start().catch((e) => {
  const place = byId('picked') ?? byId('panel');
  place.textContent = `${e.message}\nThis page needs WebGL.`;
  document.title = `failed: ${e.message}`;
});
