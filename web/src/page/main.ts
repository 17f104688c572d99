// SPDX-License-Identifier: Apache-2.0
import 'uplot/dist/uPlot.min.css';
import './style.css';
import { parseReport } from '../data/parse';
import { h } from '../dom';
import { showPage } from './frame';
import { layoutPage } from './layout_page';
import { trackingPage } from './tracking_page';

function start(): void {
  const root = document.getElementById('report')!;
  try {
    const report = parseReport(document.getElementById('report-data')?.textContent ?? 'null');
    const content = report.schema === 'asterism-layout-report/1' ? layoutPage(report) : trackingPage(report);
    showPage(report.title, report.subtitle, content, root);
  } catch (problem) {
    root.append(h('p', { class: 'problem', role: 'alert' }, `The report cannot be shown: ${problem instanceof Error ? problem.message : String(problem)}`));
  }
}

start();
