// SPDX-License-Identifier: Apache-2.0
import type { CellReport } from './cell_report';
import type { Place } from './selection';

/// What the reader of a page about a cell in motion is looking at.
export interface CellSelection extends Place {
  point: number;  // where the error is told
  body: number;   // whose lines of sight are shown
  scale: 'linear' | 'log';  // of the errors' axes
}

/// Begins at the point with the largest predicted error.
export function firstCellSelection(report: CellReport): CellSelection {
  const worst = report.points.map((point) => Math.max(0, ...point.predicted_mm.map((value) => value ?? 0)));
  return { frame: 0, range: null, point: Math.max(0, worst.indexOf(Math.max(...worst))), body: report.body, scale: 'linear' };
}
