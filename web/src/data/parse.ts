// SPDX-License-Identifier: Apache-2.0
import type { LayoutReport } from './layout';
import type { TrackingReport } from './report';

const kSchemas = ['asterism-tracking-report/1', 'asterism-layout-report/1'];

/// The data block's text as a report; says what is wrong when it is none.
export function parseReport(text: string): TrackingReport | LayoutReport {
  const data: unknown = JSON.parse(text);
  if (data === null || typeof data !== 'object') throw new Error('this page holds no data: asterism writes them into it');
  const schema = String((data as { schema?: unknown }).schema);
  if (!kSchemas.includes(schema)) throw new Error(`this page cannot show data of the form "${schema}"`);
  return data as TrackingReport | LayoutReport;
}
