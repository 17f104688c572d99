// SPDX-License-Identifier: Apache-2.0
import { h } from '../dom';

/// What a page holds between its header and its footer.
export interface PageContent {
  sections: (HTMLElement | null)[];
  keys: string;                // what the keys do
  refresh: () => void;         // after a change of theme or size
  beforePrint: () => void;     // browsers print no WebGL
}

/// Header, sections and footer; told of themes and of printing.
export function showPage(title: string, subtitle: string, content: PageContent, root: HTMLElement): void {
  document.title = `${title} – asterism`;
  root.append(
    h('header', {}, h('span', { class: 'brand' }, 'asterism'), h('h1', {}, title), h('p', { class: 'subtitle' }, subtitle)),
    h('main', {}, ...content.sections),
    h('footer', {}, 'Keys: ', content.keys));
  const print = () => {
    content.refresh();
    content.beforePrint();
  };
  window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', content.refresh);
  window.matchMedia('print').addEventListener('change', (event) => (event.matches ? print() : content.refresh()));
  window.addEventListener('beforeprint', print);
  window.addEventListener('afterprint', () => requestAnimationFrame(content.refresh));
}
