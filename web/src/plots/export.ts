// SPDX-License-Identifier: Apache-2.0
import { csv } from '../data/csv';
import { colourOnWhite, download, h } from '../dom';
import type { Figure } from './figures';
import { svgOf } from './svg';

export function figureAsCsv(figure: Figure): string {
  const header = [figure.axis.label, ...figure.traces.map((trace) => `${trace.label} (${figure.unit})`),
    ...figure.bands.flatMap((band) => [`${band.label} low (${figure.unit})`, `${band.label} high (${figure.unit})`])];
  const columns = [...figure.traces.map((trace) => trace.values), ...figure.bands.flatMap((band) => [band.low, band.high])];
  return csv(header, figure.axis.values.map((x, i) => [x, ...columns.map((column) => column[i])]));
}

/// CSV of what is plotted, and the figure as SVG or PNG on white.
export function exportButtons(figure: Figure): HTMLElement {
  const button = (text: string, title: string, save: () => void) => h('button', { type: 'button', title, onclick: save }, text);
  const svg = () => svgOf(figure, colourOnWhite);
  return h('span', { class: 'exports', role: 'group', 'aria-label': `Save ${figure.title}` },
    button('CSV', 'Save the plotted values', () => download(`${figure.id}.csv`, new Blob([figureAsCsv(figure)], { type: 'text/csv' }))),
    button('SVG', 'Save the figure as vector graphics', () => download(`${figure.id}.svg`, new Blob([svg()], { type: 'image/svg+xml' }))),
    button('PNG', 'Save the figure as an image', () => savePng(`${figure.id}.png`, svg())));
}

/// The same for a drawing inside the page: its colours follow the theme there, and are those of print here.
export function drawingButtons(name: string, drawing: () => SVGSVGElement | null): HTMLElement {
  const text = () => {
    const copy = drawing()?.cloneNode(true) as SVGSVGElement | undefined;
    copy?.setAttribute('xmlns', 'http://www.w3.org/2000/svg');
    return (copy?.outerHTML ?? '').replace(/var\((--[\w-]+)\)/g, (_, property: string) => colourOnWhite(property));
  };
  const button = (label: string, title: string, save: () => void) => h('button', { type: 'button', title, onclick: save }, label);
  return h('span', { class: 'exports', role: 'group', 'aria-label': `Save ${name}` },
    button('SVG', 'Save the figure as vector graphics', () => download(`${name}.svg`, new Blob([text()], { type: 'image/svg+xml' }))),
    button('PNG', 'Save the figure as an image', () => savePng(`${name}.png`, text())));
}

function savePng(name: string, svg: string): void {
  const image = new Image();
  image.onload = () => {
    const canvas = h('canvas', { width: image.width * 2, height: image.height * 2 });
    const context = canvas.getContext('2d')!;
    context.scale(2, 2);
    context.fillStyle = '#fff';
    context.fillRect(0, 0, image.width, image.height);
    context.drawImage(image, 0, 0);
    canvas.toBlob((blob) => blob && download(name, blob));
  };
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`;
}
