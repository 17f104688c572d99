// SPDX-License-Identifier: Apache-2.0
import type { CellReport } from '../data/cell_report';
import type { CellSelection } from '../data/cell_selection';
import { decimals } from '../data/format';
import type { Vec3 } from '../data/parts';
import type { Shared } from '../data/selection';
import { distance, namedSpots, partFrame, type Spot } from '../data/spots';
import { h } from '../dom';
import type { CellSceneView } from '../scene/cell_scene';

/// Measures between two places: picked in the view, or chosen by name. The places move with what carries them.
export function measuringTool(report: CellReport, shared: Shared<CellSelection>, scene: () => CellSceneView | null): { element: HTMLElement; begin: () => void } {
  const named = namedSpots(report);
  let places: (Spot | null)[] = [null, null];
  let next = 0;
  const lists = [0, 1].map((i) => h('select', { 'aria-label': `Place ${'AB'[i]}`, onchange: () => set(i, named[Number(lists[i].value)] ?? null) }));
  const toggle = h('button', { type: 'button', class: 'measure', 'aria-pressed': 'false', title: 'Then click two places in the view; Esc clears', onclick: () => arm(toggle.getAttribute('aria-pressed') !== 'true') }, 'Measure');
  const clear = h('button', { type: 'button', title: 'Forget both places (Esc)', onclick: () => forget() }, 'clear');
  const answer = h('div', { class: 'measured', 'aria-live': 'polite' });
  const armed = () => toggle.getAttribute('aria-pressed') === 'true';

  const arm = (on: boolean) => {
    toggle.setAttribute('aria-pressed', String(on));
    scene()?.element.classList.toggle('measuring', on);
    show();
  };
  const forget = () => {
    [places, next] = [[null, null], 0];
    show();
  };
  const set = (i: number, spot: Spot | null) => {
    places[i] = spot;
    next = i === 0 ? 1 : 0;
    show();
  };
  const show = () => {
    lists.forEach((list, i) => {
      const spot = places[i];
      const own = spot && !named.includes(spot) ? [h('option', { value: 'picked', selected: true }, `picked on ${spot.name}`)] : [];
      list.replaceChildren(h('option', { value: '' }, '–'), ...own, ...named.map((one, k) => h('option', { value: k, selected: one === spot }, one.name)));
    });
    const there = places.filter((spot): spot is Spot => spot !== null);
    scene()?.measure(there);
    clear.disabled = there.length === 0;
    answer.replaceChildren(...(places[0] && places[1] ? [told(report, places[0], places[1], shared.now.frame)]
      : armed() ? [h('p', { class: 'note' }, there.length === 1 ? 'Click the second place.' : 'Click the first place on a surface or a target.')] : []));
  };
  document.addEventListener('keydown', (event) => {
    if (event.key !== 'Escape' || (!armed() && !places.some(Boolean))) return;
    if (places.some(Boolean)) forget();
    else arm(false);
  });
  shared.watch((now, before) => now.frame !== before.frame && places.some(Boolean) && show());
  const begin = () => {
    scene()?.onClick((x, y) => {
      const spot = armed() ? scene()?.pick(x, y) : null;
      if (!spot) return;
      if (places[0] && places[1]) [places, next] = [[null, null], 0];
      // A named place keeps its name in the list.
      set(next, named.find((one) => one.name === spot.name && one.carrier === spot.carrier && one.at.every((v, k) => v === spot.at[k])) ?? spot);
    });
    show();
  };
  return { element: h('div', { class: 'measuring-tool' }, h('div', { class: 'bar-row' }, toggle, h('span', { class: 'choice-label' }, 'from'), lists[0], h('span', { class: 'choice-label' }, 'to'), lists[1], clear), answer), begin };
}

function told(report: CellReport, from: Spot, to: Spot, frame: number): HTMLElement {
  const { length, inTracker, inPart } = distance(report, from, to, frame);
  const row = (name: string, v: Vec3) => h('tr', {}, h('th', { scope: 'row' }, name), ...v.map((value) => h('td', { class: 'number' }, decimals(value, 2))));
  return h('table', { class: 'data' },
    h('thead', {}, h('tr', {}, h('th', { scope: 'col' }, h('b', { class: 'length' }, `${decimals(length, 2)} mm`), ' from A to B'), ...['dx', 'dy', 'dz (mm)'].map((head) => h('th', { scope: 'col', class: 'number' }, head)))),
    h('tbody', {}, row('along the tracker\'s axes', inTracker), row(`along the part's axes (${partFrame(report).name})`, inPart)));
}
