// SPDX-License-Identifier: Apache-2.0
import { lengthBound95 } from './bands';
import type { CellPoint, CellReport } from './cell_report';
import { csv } from './csv';
import type { Covariance } from './pose';
import { targetWords } from './sight';
import type { Column } from './statistics';
import { kStatuses, type Status } from './status';

/// What the length of the error at a point stays below with probability 95 %, by frame.
export function bound95(point: CellPoint): Column {
  return point.predicted_mm.map((_, i) => {
    const covariance = point.covariance_mm2[i];
    return covariance ? lengthBound95(covariance as Covariance) : null;
  });
}

/// Frames in which what is drawn lies above a limit, of those where it is known.
export function above(values: Column, limit: number): { frames: number; of: number } {
  const known = values.filter((value) => value !== null);
  return { frames: known.filter((value) => value! > limit).length, of: known.length };
}

/// Everything that is drawn over time, a row a frame.
export function cellAsCsv(report: CellReport): string {
  const body = report.bodies[report.body];
  const bounds = report.points.map(bound95);
  const header = ['time_s', ...['x_mm', 'y_mm', 'z_mm', 'qw', 'qx', 'qy', 'qz'], 'visible', 'coverage', 'status',
    ...report.points.flatMap(({ name }) => [`${name} predicted_mm`, `${name} bound95_mm`, `${name} measured_mm`, `${name} without_mm`]),
    'predicted_rotation_deg', 'measured_rotation_deg', 'without_mm', 'without_deg', ...body.targets.map((target) => `sight ${target.id}`)];
  return csv(header, report.time_s.map((time, i) => [
    time, ...body.pose[i], report.visible[i], report.coverage[i], kStatuses[report.status[i] as Status]?.word ?? '',
    ...report.points.flatMap((point, p) => [point.predicted_mm[i], bounds[p][i], point.measured_mm[i], point.without_mm[i]]),
    report.predicted_rotation_deg[i], report.measured_rotation_deg[i], report.without_mm[i], report.without_deg[i],
    ...body.targets.map((_, t) => targetWords(body, t, i, report.solids)),
  ]));
}
