// SPDX-License-Identifier: Apache-2.0
type Child = Node | string | null | undefined | false;

/// An element with its attributes and children. Text is always text: no data can become markup.
export function h<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag, attributes: Record<string, string | number | boolean | ((event: Event) => void)> = {}, ...children: Child[]
): HTMLElementTagNameMap[Tag] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function') element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, '');
    else if (value !== false) element.setAttribute(name, String(value));
  }
  for (const child of children) if (child) element.append(child);
  return element;
}

/// The same for drawings inside the page.
export function svg<Tag extends keyof SVGElementTagNameMap>(
  tag: Tag, attributes: Record<string, string | number | ((event: Event) => void)> = {}, ...children: Child[]
): SVGElementTagNameMap[Tag] {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function') element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, String(value));
  }
  for (const child of children) if (child) element.append(child);
  return element;
}

export function download(name: string, content: Blob): void {
  const link = h('a', { href: URL.createObjectURL(content), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/// The value of a custom property as it is now: light, dark or print.
export function colour(property: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(property).trim() || '#888';
}

/// The same for drawings on white, which keep their colours in the dark.
export function colourOnWhite(property: string): string {
  const probe = h('span', { class: 'on-white', hidden: true });
  document.body.append(probe);
  const value = getComputedStyle(probe).getPropertyValue(property).trim();
  probe.remove();
  return value || '#888';
}

/// One of several, as a row of buttons of which one is pressed.
export function choice<T extends string | number>(label: string, options: { value: T; text: string }[], now: T, choose: (value: T) => void): { element: HTMLElement; show: (value: T) => void } {
  const buttons = options.map(({ value, text }) => h('button', { type: 'button', onclick: () => choose(value) }, text));
  const show = (value: T) => buttons.forEach((button, i) => button.setAttribute('aria-pressed', String(options[i].value === value)));
  show(now);
  return { element: h('div', { class: 'choice', role: 'group', 'aria-label': label }, h('span', { class: 'choice-label' }, label), ...buttons), show };
}

/// One of many, from a list.
export function picker(label: string, options: { value: string; text: string }[], now: string, choose: (value: string) => void): { element: HTMLElement; show: (value: string) => void } {
  const list = h('select', { 'aria-label': label }, ...options.map(({ value, text }) => h('option', { value }, text)));
  list.value = now;
  list.addEventListener('change', () => choose(list.value));
  return { element: h('label', { class: 'picker' }, h('span', { class: 'choice-label' }, label), list), show: (value) => (list.value = value) };
}
