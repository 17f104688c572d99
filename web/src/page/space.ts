// SPDX-License-Identifier: Apache-2.0
import { download, h } from '../dom';
import type { Stage } from '../scene/stage';

export type Space<Layer, View> = Pick<Stage, 'element' | 'refresh' | 'still' | 'png'> & {
  setLayer: (layer: Layer, visible: boolean) => void;
  look: (from: View) => void;
};

export interface SpacePanel<Scene> {
  element: HTMLElement;
  scene: Scene | null;
  refresh: () => void;
  still: () => void;
}

/// What the panel offers: where to look from, what to show, and what stands above and below the view.
export interface SpaceContent<Layer, View> {
  words: string;
  views: View[];
  layers: { layer: Layer; text: string; shown: boolean }[];
  above?: HTMLElement;
  below: HTMLElement[];
}

/// A 3-D view with its controls; without WebGL a sentence in its place.
export function spacePanel<Layer extends string, View extends string, Scene extends Space<Layer, View>>(
  make: () => Scene, { words, views, layers, above, below }: SpaceContent<Layer, View>,
): SpacePanel<Scene> {
  let scene: Scene | null = null;
  try {
    scene = make();
  } catch {
    // No WebGL: numbers and plots still tell everything.
  }
  const toggles = layers.map(({ layer, text, shown }) => {
    const box = h('input', { type: 'checkbox', checked: shown });
    box.addEventListener('change', () => scene?.setLayer(layer, box.checked));
    return h('label', { 'data-layer': layer }, box, text);
  });
  const buttons = views.map((view) => h('button', { type: 'button', onclick: () => scene?.look(view) }, view));
  const save = h('button', { type: 'button', title: 'Save the view as an image', onclick: async () => {
    const blob = await scene?.png();
    if (blob) download('view.png', blob);
  } }, 'PNG');
  const element = h('section', { class: 'panel space', 'aria-label': words },
    above,
    h('div', { class: 'bar-row' },
      h('div', { class: 'choice', role: 'group', 'aria-label': 'Look from' }, h('span', { class: 'choice-label' }, 'View'), ...buttons),
      h('span', { class: 'exports' }, save)),
    scene ? scene.element : h('p', { class: 'scene none' }, 'This browser draws no WebGL, so there is no 3-D view; the plots and tables below are complete.'),
    below[0],
    h('div', { class: 'layers', role: 'group', 'aria-label': 'Shown in the view' }, ...toggles),
    ...below.slice(1));
  if (scene) {
    const view = scene;
    requestAnimationFrame(() => {
      view.refresh();
      view.look(views[0]);
    });
  }
  return { element, scene, refresh: () => scene?.refresh(), still: () => scene?.still() };
}
