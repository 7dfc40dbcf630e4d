// SPDX-License-Identifier: Apache-2.0
//
// Parts of panels: elements, a list to choose from, a timeline.

import { soon } from './picture.js';

export const byId = (id) => document.getElementById(id);

/** An element with properties and children; `on...` are listeners, unknown names attributes. */
export function element(tag, properties = {}, ...children) {
  const out = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name.startsWith('on')) out.addEventListener(name.slice(2), value);
    else if (name in out && name !== 'list') out[name] = value;
    else out.setAttribute(name, value);
  }
  out.append(...children);
  return out;
}

/** A list of which one item is chosen, by click or by keys. */
export class ChoiceList {
  constructor(id, label, items, choose) {
    this.choose = choose;
    this.index = -1;
    this.options = items.map((content, i) =>
      element(
        'div',
        { role: 'option', id: `${id}-${i}`, 'aria-selected': 'false', onclick: () => this.select(i) },
        ...content,
      ),
    );
    this.element = element(
      'div',
      { id, role: 'listbox', tabIndex: 0, 'aria-label': label, onkeydown: (e) => this.key(e) },
      ...this.options,
    );
  }

  select(i) {
    this.options[this.index]?.setAttribute('aria-selected', 'false');
    this.index = i;
    const option = this.options[i];
    if (option) {
      option.setAttribute('aria-selected', 'true');
      this.element.setAttribute('aria-activedescendant', option.id);
      const { offsetTop: top, offsetHeight: height } = option;
      const box = this.element;
      if (top < box.scrollTop) box.scrollTop = top;
      if (top + height > box.scrollTop + box.clientHeight)
        box.scrollTop = top + height - box.clientHeight;
    }
    this.choose(i);
  }
  step(by) {
    if (!this.options.length) return;
    this.select(Math.min(this.options.length - 1, Math.max(0, this.index + by)));
  }
  key(e) {
    const steps = { ArrowDown: 1, ArrowUp: -1, PageDown: 10, PageUp: -10, Home: -1e9, End: 1e9 };
    if (!(e.key in steps)) return;
    e.preventDefault();
    e.stopPropagation();
    this.step(steps[e.key]);
  }
}

/** Frames in order: a slider, playing, and a moment of its own. */
export class Timeline {
  /** `show(frame)` is called for each frame that is to be seen. */
  constructor(facts, show) {
    this.facts = facts;
    this.count = facts.times.length;
    this.contact = facts.contact;
    this.show = show;
    this.frame = 0;
    this.seconds = 6; // of all frames, at speed 1
    this.play = element('button', { onclick: () => this.toggle(), textContent: 'play' });
    this.slider = element('input', {
      type: 'range', min: 0, max: this.count - 1, value: 0, 'aria-label': 'moment',
      oninput: () => {
        this.pause();
        this.seek(Number(this.slider.value));
      },
    });
    const track = element('span', { className: 'track' }, this.slider);
    if (this.contact !== null) {
      this.tick = element('i', { title: 'first contact' });
      track.append(this.tick);
      const part = this.contact / Math.max(1, this.count - 1);
      this.tick.style.left = `calc(${100 * part}% + ${8 - 16 * part}px)`;
    }
    this.toContact = element('button', {
      textContent: 'contact', hidden: this.contact === null,
      onclick: () => {
        this.pause();
        this.seek(this.contact);
      },
    });
    this.speed = element(
      'select',
      { 'aria-label': 'speed' },
      ...[0.1, 0.25, 0.5, 1, 2].map((s) => element('option', { value: s, selected: s === 1 }, `${s}×`)),
    );
    this.text = element('div', { id: 'moment', role: 'status' });
    this.elements = [
      element('div', { className: 'row' }, this.play, track, this.toContact, this.speed),
      this.text,
    ];
  }

  seek(frame) {
    this.frame = Math.min(this.count - 1, Math.max(0, frame));
    this.slider.value = this.frame;
    const { times, unit } = this.facts;
    const number = (x) => String(Number(x.toPrecision(9)));
    const where =
      this.contact === null ? ''
      : this.frame < this.contact ? ''
      : this.frame === this.contact ? ' — first contact'
      : ' — after the contact';
    this.text.textContent =
      `${unit} ${number(times[this.frame])} of ${number(times.at(-1))}${where}`;
    this.text.className = this.contact !== null && this.frame >= this.contact ? 'error' : '';
    this.slider.setAttribute('aria-valuetext', this.text.textContent);
    this.show(this.frame);
  }

  toggle() {
    if (this.playing) this.pause();
    else this.start();
  }
  pause() {
    this.playing = false;
    this.play.textContent = 'play';
  }
  /** Plays to the contact, or from there to the end; resolves where it stops. */
  start() {
    if (this.frame === this.count - 1) this.seek(0);
    const stop = this.contact !== null && this.frame < this.contact ? this.contact : this.count - 1;
    this.playing = true;
    this.play.textContent = 'pause';
    const first = this.frame;
    const start = performance.now();
    return new Promise((resolve) => {
      const step = () => {
        if (!this.playing) return resolve(this.frame);
        const passed = ((performance.now() - start) / 1000) * Number(this.speed.value);
        const frame = Math.min(stop, first + Math.floor((passed / this.seconds) * (this.count - 1)));
        if (frame !== this.frame) this.seek(frame);
        if (frame < stop) return soon(step);
        this.pause();
        return resolve(this.frame);
      };
      soon(step);
    });
  }
}
