// SPDX-License-Identifier: Apache-2.0
import 'uplot/dist/uPlot.min.css';
import './style.css';
import { parseReport, type Report } from '../data/parse';
import { h } from '../dom';
import { cellPage } from './cell_page';
import { showPage, type PageContent } from './frame';
import { layoutPage } from './layout_page';
import { scanPage } from './scan_page';
import { trackingPage } from './tracking_page';

function contentOf(report: Report): PageContent {
  switch (report.schema) {
    case 'asterism-tracking-report/1': return trackingPage(report);
    case 'asterism-layout-report/1': return layoutPage(report);
    case 'asterism-cell-report/1': return cellPage(report);
    case 'asterism-scan-report/1': return scanPage(report);
  }
}

function start(): void {
  const root = document.getElementById('report')!;
  try {
    const report = parseReport(document.getElementById('report-data')?.textContent ?? 'null');
    const content = contentOf(report);
    showPage(report.title, report.subtitle, content, root);
  } catch (problem) {
    root.append(h('p', { class: 'problem', role: 'alert' }, `The report cannot be shown: ${problem instanceof Error ? problem.message : String(problem)}`));
  }
}

start();
