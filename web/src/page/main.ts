// SPDX-License-Identifier: Apache-2.0
import 'uplot/dist/uPlot.min.css';
import './style.css';
import { parseReport, type TrackingReport } from '../data/report';
import { Shared } from '../data/selection';
import { h } from '../dom';
import { errorSection } from '../tables/errors';
import { eventSection } from '../tables/events';
import { optionSection } from '../tables/options';
import { summarySection } from '../tables/summary';
import { targetSection } from '../tables/targets';
import { workspace } from './workspace';

function show(report: TrackingReport, root: HTMLElement): void {
  document.title = `${report.title} – asterism`;
  const shared = new Shared({
    frame: 0, body: 0, component: 'size', range: null,
    source: 'measured',
  });
  const main = h('main', {}, summarySection(report));
  root.append(
    h('header', {}, h('span', { class: 'brand' }, 'asterism'), h('h1', {}, report.title), h('p', { class: 'subtitle' }, report.subtitle)),
    main,
    h('footer', {}, 'Keys: ', h('kbd', {}, '←'), ' ', h('kbd', {}, '→'), ' step a frame, with ', h('kbd', {}, 'Shift'), ' ten, ', h('kbd', {}, 'Space'), ' plays. Point into a plot to see that frame; drag in a plot to look closer, double-click for the whole time.'));
  if (report.frames.frame.length > 0) {
    const work = workspace(report, shared);
    main.append(work.element);
    const print = () => {
      work.refresh();
      work.beforePrint();
    };
    window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', work.refresh);
    window.matchMedia('print').addEventListener('change', (event) => (event.matches ? print() : work.refresh()));
    window.addEventListener('beforeprint', print);
    window.addEventListener('afterprint', () => requestAnimationFrame(work.refresh));
  }
  const errors = errorSection(report);
  if (errors) main.append(errors);
  main.append(targetSection(report), eventSection(report, shared), optionSection(report));
}

function start(): void {
  const root = document.getElementById('report')!;
  try {
    show(parseReport(document.getElementById('report-data')?.textContent ?? 'null'), root);
  } catch (problem) {
    root.append(h('p', { class: 'problem', role: 'alert' }, `The report cannot be shown: ${problem instanceof Error ? problem.message : String(problem)}`));
  }
}

start();
