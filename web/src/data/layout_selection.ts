// SPDX-License-Identifier: Apache-2.0
import { objectivesOf, type LayoutReport } from './layout';
import type { Place } from './selection';

/// What the reader of a page about layouts is looking at.
export interface LayoutSelection extends Place {
  layout: number;            // a place in the report's layouts
  against: number | null;    // the one it is compared with
  x: number;                 // measures on the axes of the chart
  y: number;
  shade: number | null;      // measure told by colour
}

/// Begins at the knee, else at the first layout, against the present one; on the axes the first objectives.
export function firstSelection(report: LayoutReport): LayoutSelection {
  const objectives = objectivesOf(report);
  const rest = report.measures.map((_, i) => i).filter((i) => !objectives.includes(i));
  const [x, y, shade] = [...objectives, ...rest];
  const present = report.layouts.findIndex((layout) => layout.reference);
  return {
    layout: report.knee ?? 0, against: present >= 0 ? present : null, frame: 0, range: null,
    x: x ?? 0, y: y ?? 0, shade: objectives.length > 2 ? shade : null,
  };
}
