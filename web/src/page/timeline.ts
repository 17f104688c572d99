// SPDX-License-Identifier: Apache-2.0
import { decimals } from '../data/format';
import type { Frames, Place, Shared } from '../data/selection';
import { h } from '../dom';

const kSpeeds = [0.1, 0.25, 0.5, 1, 2, 5, 10];

/// Play, step and slide through the frames; the keys work anywhere on the page.
export function timeline<S extends Place>({ frame, time_s }: Frames, shared: Shared<S>, word = 'frame'): HTMLElement {
  const last = frame.length - 1;
  const go = (to: number) => shared.set({ frame: to } as Partial<S>);
  const step = (by: number) => {
    stop();
    go(Math.min(last, Math.max(0, shared.now.frame + by)));
  };
  const play = h('button', { type: 'button', class: 'play', 'aria-label': 'Play', onclick: () => (playing ? stop() : start()) }, '▶');
  const slider = h('input', { type: 'range', min: 0, max: last, value: 0, step: 1, 'aria-label': word });
  const speed = h('select', { 'aria-label': 'Speed', title: 'Speed' }, ...kSpeeds.map((s) => h('option', { value: s, selected: s === 1 }, `${s} ×`)));
  const where = h('output', { class: 'where' });

  let playing = false;
  let shownFrame = -1;
  let begun = { clock: 0, time: 0 };
  const tick = (clock: number) => {
    if (!playing) return;
    // Someone pointed elsewhere while it played: go on from there.
    if (shared.now.frame !== shownFrame) begun = { clock, time: time_s[shared.now.frame] };
    const time = begun.time + ((clock - begun.clock) / 1000) * Number(speed.value);
    let next = shared.now.frame;
    while (next < last && time_s[next + 1] <= time) ++next;
    shownFrame = next;
    go(next);
    if (next === last) stop();
    else requestAnimationFrame(tick);
  };
  const start = () => {
    if (shared.now.frame === last) go(0);
    playing = true;
    shownFrame = -1;
    play.textContent = '❚❚';
    play.setAttribute('aria-label', 'Pause');
    requestAnimationFrame(tick);
  };
  const stop = () => {
    playing = false;
    play.textContent = '▶';
    play.setAttribute('aria-label', 'Play');
  };
  speed.addEventListener('change', () => (shownFrame = -1));
  slider.addEventListener('input', () => {
    stop();
    go(Number(slider.value));
  });
  document.addEventListener('keydown', (event) => {
    const at = event.target as HTMLElement;
    if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey || at.tagName === 'SELECT') return;
    if (event.key === ' ' && (at.tagName === 'BUTTON' || at.tagName === 'SUMMARY')) return;
    const moves: Record<string, () => void> = {
      ArrowLeft: () => step(event.shiftKey ? -10 : -1), ArrowRight: () => step(event.shiftKey ? 10 : 1),
      ' ': () => (playing ? stop() : start()),
      ...(at.tagName === 'INPUT' || at === document.body || at.tagName === 'CANVAS' ? { Home: () => step(-last), End: () => step(last) } : {}),
    };
    const move = moves[event.key];
    if (!move) return;
    event.preventDefault();
    move();
  });

  const show = () => {
    const i = shared.now.frame;
    slider.value = String(i);
    const words = `${word} ${frame[i]} · ${decimals(time_s[i], 3)} s`;
    slider.setAttribute('aria-valuetext', words);
    where.textContent = words;
  };
  shared.watch((after, before) => after.frame !== before.frame && show());
  show();
  const button = (text: string, label: string, by: number) => h('button', { type: 'button', 'aria-label': label, title: label, onclick: () => step(by) }, text);
  return h('div', { class: 'timeline' }, play, button('‹', `One ${word} back (arrow left)`, -1), button('›', `One ${word} on (arrow right)`, 1), slider, where, speed);
}
