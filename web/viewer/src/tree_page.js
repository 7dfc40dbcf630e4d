// SPDX-License-Identifier: Apache-2.0
//
// Partitions behind a solid: their cuts, level by level, and a point that goes down through them.

import * as THREE from 'three';

import { element } from './parts.js';
import { darkness, mark, randomNumbers } from './picture.js';
import { boxRegion, cutOf, endsOf, partOf, trianglesOf } from './region.js';
import { StagePage } from './stage_page.js';
import { CellTree, PlaneTree } from './trees.js';

// More regions than these are not drawn.
const mostRegions = 6000;
const sides = { '-1': 'below', 0: 'on', 1: 'above' };

export class TreePage extends StagePage {
  extend() {
    const read = (name) => new TextDecoder().decode(this.arrays.bytes(name));
    this.trees = { cells: new CellTree(this.facts, read('cells')) };
    if (this.facts.places.planes) this.trees.planes = new PlaneTree(this.facts, read('planes'));
    this.seed = 1;
    const { shape } = this.stage.bodies[0];
    this.shape = shape;
    const margin = shape.high.map((h, k) => 0.08 * (h - shape.low[k]) + 0.02 * this.stage.size);
    this.box = boxRegion(
      shape.low.map((l, k) => l - margin[k]),
      shape.high.map((h, k) => h + margin[k]),
    );
    this.addPictures();
    this.addLevels();
    this.addFollowing();
    this.selects[0].value = 'clear';
    this.stage.setLook(this.stage.bodies[0], 'clear');
    this.stage.lookFrom([0.8, -1.5, 0.75]);
    // A tree of one leaf shows nothing.
    this.use(this.trees.cells.cuts === 0 && this.trees.planes ? 'planes' : 'cells');
  }

  mostEdges() {
    return 4000;
  }

  addPictures() {
    const { stage } = this;
    const dark = darkness.matches;
    const thin = (color, opacity) => {
      const out = new THREE.LineSegments(
        new THREE.BufferGeometry(),
        new THREE.LineBasicMaterial({ color, transparent: true, opacity }),
      );
      out.raycast = () => {};
      out.frustumCulled = false;
      stage.scene.add(out);
      return out;
    };
    this.oldCuts = thin(dark ? '#c3ccd6' : '#46505c', 0.5);
    this.openCells = thin(dark ? '#f0a04b' : '#b35900', 0.9);
    this.insides = stage.addAreas(dark ? '#56b4e9' : '#0072b2');
    this.insides.material.depthTest = true;
    this.insides.material.opacity = 0.35;
    this.newCuts = stage.addLine(mark, 2);
    this.newCuts.renderOrder = 6;
    this.freshFill = stage.addAreas(mark);
    this.freshFill.material.opacity = 0.1;
    this.regionLine = stage.addLine(dark ? '#ffffff' : '#10161d', 3);
    this.cutFill = stage.addAreas(mark);
    this.cutFill.material.opacity = 0.3;
    this.cutLine = stage.addLine(mark, 4);
    this.pointDot = stage.addDots(mark, 15, 9);
    this.pointHalo = stage.addDots('#ffffff', 21, 8);
  }

  addLevels() {
    this.select = element(
      'select',
      { 'aria-label': 'which tree', onchange: () => this.use(this.select.value) },
      ...Object.entries(this.trees).map(([k, t]) => element('option', { value: k }, t.label)),
    );
    this.counts = element('div', { id: 'counts' });
    this.slider = element('input', {
      type: 'range', min: 0, value: 0, 'aria-label': 'level',
      oninput: () => this.showLevel(Number(this.slider.value)),
    });
    this.levelText = element('div', { id: 'level-text', role: 'status' });
    this.panel.append(
      element('h2', {}, 'tree'),
      element('label', {}, this.select),
      this.counts,
      element('label', {}, 'levels', this.slider),
      this.levelText,
    );
    if (this.facts.no_planes)
      this.panel.append(element('div', {}, `planes of faces: not here, ${this.facts.no_planes}`));
  }

  addFollowing() {
    this.inputs = ['x', 'y', 'z'].map((name) =>
      element('input', {
        type: 'text', size: 5, 'aria-label': name, inputMode: 'decimal',
        onkeydown: (e) => e.key === 'Enter' && this.followInputs(),
      }),
    );
    this.steps = element('ol', { className: 'steps', id: 'steps', tabIndex: 0, 'aria-label': 'steps' });
    this.answer = element('div', { id: 'leaf', role: 'status' });
    this.panel.append(
      element('h2', {}, 'a point goes down'),
      element('label', {}, ...this.inputs),
      element(
        'label',
        {},
        element('button', { onclick: () => this.followInputs() }, 'follow'),
        element('button', { onclick: () => this.followRandom() }, 'another'),
        element('button', { onclick: () => this.playSteps() }, 'play'),
      ),
      this.steps,
      this.answer,
    );
  }

  keyWords() {
    return '[ and ] levels, F another point, comma and dot its steps, space play them. ';
  }
  keys() {
    return {
      '[': () => this.showLevel(this.level - 1),
      ']': () => this.showLevel(this.level + 1),
      f: () => this.followRandom(),
      ',': () => this.showStep(this.step - 1),
      '.': () => this.showStep(this.step + 1),
      ' ': () => this.playSteps(),
    };
  }
  // A click on the surface follows that point.
  show(item) {
    super.show(item);
    this.inputs.forEach((input, k) => (input.value = item.point[k]));
    this.followInputs();
  }
  forget() {
    super.forget();
    this.path = null;
    this.steps.replaceChildren();
    this.answer.textContent = '';
    this.clearStep();
    if (this.tree) this.showLevel(this.level);
  }

  use(name) {
    this.treeName = name;
    this.select.value = name;
    this.tree = this.trees[name];
    this.slider.max = this.tree.depth;
    this.counts.textContent =
      this.tree.cuts === 0
        ? 'one leaf that lists all facets: nothing has cut this solid'
        : `${this.tree.cuts} cuts of space, depth ${this.tree.depth}`;
    this.forget();
    this.showLevel(Math.min(this.tree.depth, 4));
  }

  // --- Levels ---

  /** Regions at a level, and the cuts above them. */
  regionsAt(level) {
    const { tree } = this;
    const out = { old: [], fresh: [], open: [], inside: [], counts: { cuts: 0, inside: 0, outside: 0, open: 0 } };
    const stack = [{ ref: tree.root, region: this.box, depth: 0 }];
    let regions = 0;
    while (stack.length) {
      const { ref, region, depth } = stack.pop();
      if (++regions > mostRegions) {
        out.tooMany = true;
        break;
      }
      if (!tree.isLeaf(ref) && depth < level) {
        const cut = tree.cut(ref);
        ++out.counts.cuts;
        (depth === level - 1 ? out.fresh : out.old).push(cutOf(region, cut));
        for (const side of [1, -1])
          stack.push({ ref: tree.child(ref, side), region: partOf(region, cut, side), depth: depth + 1 });
        continue;
      }
      const kind = tree.isLeaf(ref) ? tree.leaf(ref).kind : 'open';
      if (kind === 'inside') out.inside.push(...region.polygons);
      else if (kind !== 'outside') out.open.push(...region.polygons);
      ++out.counts[kind === 'inside' || kind === 'outside' ? kind : 'open'];
    }
    return out;
  }

  showLevel(level) {
    this.level = Math.min(this.tree.depth, Math.max(0, level));
    this.slider.value = this.level;
    const r = this.regionsAt(this.level);
    const { stage } = this;
    const thin = (line, polygons) => {
      line.geometry.dispose();
      line.geometry = new THREE.BufferGeometry().setAttribute(
        'position',
        new THREE.Float32BufferAttribute(endsOf(polygons).flatMap((p) => stage.local(p)), 3),
      );
      line.visible = true;
    };
    thin(this.oldCuts, r.old);
    thin(this.openCells, r.open);
    stage.setLine(this.newCuts, endsOf(r.fresh).flatMap((p) => stage.local(p)));
    this.fill(this.insides, r.inside);
    this.fill(this.freshFill, r.fresh.length <= 40 ? r.fresh : []);
    this.showing = { level: this.level, ...r.counts };
    const { cuts, inside, outside, open } = r.counts;
    this.levelText.textContent = r.tooMany
      ? 'more regions than are drawn here'
      : `level ${this.level} of ${this.tree.depth}: ${cuts} cuts; regions: ${inside} inside (blue), ` +
        `${outside} outside, ${open} to be divided or with facets (orange)`;
    stage.draw();
  }

  fill(mesh, polygons) {
    const corners = trianglesOf(polygons).flatMap((p) => this.stage.local(p));
    mesh.visible = corners.length > 0;
    mesh.geometry.dispose();
    mesh.geometry = new THREE.BufferGeometry().setAttribute(
      'position',
      new THREE.Float32BufferAttribute(corners, 3),
    );
  }

  // --- A point ---

  /** Down the tree to a leaf: the cuts, the sides, the regions. */
  pathOf(tree, p) {
    const steps = [];
    let ref = tree.root;
    while (!tree.isLeaf(ref)) {
      const side = tree.side(ref, p);
      steps.push({ ref, side });
      ref = tree.child(ref, side);
    }
    return { point: p, steps, leaf: tree.leaf(ref) };
  }

  // What the facets of a leaf say.
  decision(path) {
    if (path.leaf.kind !== 'facets') return path.leaf.kind;
    const w = this.shape.windingNumber(path.point);
    if (Math.abs(w - Math.round(w)) > 1e-6) return 'near';
    return Math.round(w) > 0 ? 'inside' : 'outside';
  }

  followInputs() {
    const p = this.inputs.map((input) => Number(input.value || '0'));
    if (!p.every(Number.isFinite)) {
      this.answer.textContent = 'three numbers, please';
      return;
    }
    this.follow(p);
  }
  followRandom() {
    const random = randomNumbers(this.seed++ * 7919);
    const { low, high } = this.shape;
    const p = low.map((l, k) => Number((l + (high[k] - l) * random()).toPrecision(6)));
    this.inputs.forEach((input, k) => (input.value = p[k]));
    this.follow(p);
  }

  follow(p) {
    this.path = this.pathOf(this.tree, p);
    let region = this.box;
    this.regions = [region];
    for (const s of this.path.steps) {
      region = partOf(region, this.tree.cut(s.ref), s.side);
      this.regions.push(region);
    }
    this.steps.replaceChildren(
      ...this.path.steps.map((s, i) =>
        element(
          'li',
          { onclick: () => this.showStep(i) },
          `${['point', 'line', 'plane'][this.tree.dimension(s.ref) - 1]} ${this.tree.cutText(s.ref)}: ` +
            sides[s.side],
        ),
      ),
    );
    const { leaf, steps } = this.path;
    const said = this.decision(this.path);
    this.answer.textContent =
      `${steps.length} cuts, then ${leaf.text}` +
      (leaf.kind !== 'facets' ? '.'
        : said === 'near' ? ': too near the surface for the sum of angles; ask `trisect locate`.'
        : `. Winding number ${said === 'inside' ? 1 : 0}: ${said}.`);
    this.hideLevels();
    this.showStep(steps.length);
  }

  hideLevels() {
    for (const o of [this.oldCuts, this.openCells, this.newCuts, this.freshFill, this.insides])
      o.visible = false;
  }
  clearStep() {
    for (const o of [this.regionLine, this.cutFill, this.cutLine, this.pointDot, this.pointHalo])
      o.visible = false;
  }

  /** The region before a cut, and the cut; at the end the region of the leaf. */
  showStep(i) {
    if (!this.path) return;
    const { stage } = this;
    this.step = Math.min(this.path.steps.length, Math.max(0, i));
    [...this.steps.children].forEach((li, k) => {
      if (k === this.step) {
        li.setAttribute('aria-current', 'step');
        const box = this.steps;
        if (li.offsetTop < box.scrollTop) box.scrollTop = li.offsetTop;
        if (li.offsetTop + li.offsetHeight > box.scrollTop + box.clientHeight)
          box.scrollTop = li.offsetTop + li.offsetHeight - box.clientHeight;
      } else {
        li.removeAttribute('aria-current');
      }
    });
    const region = this.regions[this.step];
    const s = this.path.steps[this.step];
    const cut = s ? cutOf(region, this.tree.cut(s.ref)) : [];
    const local = (points) => points.flatMap((p) => stage.local(p));
    this.hideLevels();
    stage.setLine(this.regionLine, local(endsOf(region.polygons)));
    stage.setLine(this.cutLine, local(endsOf([cut])));
    this.fill(this.cutFill, [cut]);
    stage.setDots(this.pointDot, [this.path.point]);
    stage.setDots(this.pointHalo, [this.path.point]);
    stage.draw();
  }

  playSteps() {
    if (!this.path) this.followRandom();
    clearInterval(this.playing);
    this.showStep(0);
    this.playing = setInterval(() => {
      if (!this.path || this.step >= this.path.steps.length) clearInterval(this.playing);
      else this.showStep(this.step + 1);
    }, 600);
  }

  // --- For programs ---

  driver() {
    return {
      ...super.driver(),
      follow: (p, step) => {
        this.inputs.forEach((input, k) => (input.value = p[k]));
        this.follow(p);
        if (step !== undefined) this.showStep(step);
      },
      use: (name) => this.use(name),
      level: (n) => this.showLevel(n),
      trees: () => Object.fromEntries(Object.entries(this.trees).map(([k, t]) => [k, { cuts: t.cuts, depth: t.depth }])),
      locate: (points) => this.locations(points),
    };
  }
  locations(points) {
    return points.map((p) =>
      Object.fromEntries(
        Object.entries(this.trees).map(([name, tree]) => {
          const path = this.pathOf(tree, p);
          return [
            name,
            { steps: path.steps.length, kind: path.leaf.kind, entity: path.leaf.entity, said: this.decision(path) },
          ];
        }),
      ),
    );
  }
  async report(question) {
    const out = await super.report(question);
    out.locations = this.locations(question.points ?? []);
    out.levels = [];
    for (const name of Object.keys(this.trees)) {
      this.use(name);
      for (const n of question.levels ?? []) {
        this.showLevel(n);
        out.levels.push({ tree: name, ...this.showing });
      }
    }
    return out;
  }
}

