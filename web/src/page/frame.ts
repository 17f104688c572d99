// SPDX-License-Identifier: Apache-2.0
import { h } from '../dom';

/// Another page that lies beside this one.
export interface PageLink {
  text: string;
  href: string;                // relative to this page
}

/// What a page holds between its header and its footer.
export interface PageContent {
  links?: PageLink[];
  sections: (HTMLElement | null)[];
  keys: string;                // what the keys do
  refresh: () => void;         // after a change of theme or size
  beforePrint: () => void;     // browsers print no WebGL
}

function linksLine(links: PageLink[]): HTMLElement[] {
  if (links.length === 0) return [];
  return [h('nav', { class: 'subtitle', 'aria-label': 'Other pages' }, ...links.map(({ text, href }) => h('a', { href }, text)))];
}

/// Header, sections and footer; told of themes and of printing.
export function showPage(title: string, subtitle: string, content: PageContent, root: HTMLElement): void {
  document.title = `${title} – asterism`;
  root.append(
    h('header', {}, h('span', { class: 'brand' }, 'asterism'), h('h1', {}, title), h('p', { class: 'subtitle' }, subtitle), ...linksLine(content.links ?? [])),
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
