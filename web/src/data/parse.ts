// SPDX-License-Identifier: Apache-2.0
import type { CellReport } from './cell_report';
import type { LayoutReport } from './layout';
import type { TrackingReport } from './report';
import type { ScanReport } from './scan_report';

export type Report = TrackingReport | LayoutReport | CellReport | ScanReport;

const kSchemas: string[] = ['asterism-tracking-report/1', 'asterism-layout-report/1', 'asterism-cell-report/1', 'asterism-scan-report/1'] satisfies Report['schema'][];

/// The data block's text as a report; says what is wrong when it is none.
export function parseReport(text: string): Report {
  const data: unknown = JSON.parse(text);
  if (data === null || typeof data !== 'object') throw new Error('this page holds no data: asterism writes them into it');
  const schema = String((data as { schema?: unknown }).schema);
  if (!kSchemas.includes(schema)) throw new Error(`this page cannot show data of the form "${schema}"`);
  return data as Report;
}
