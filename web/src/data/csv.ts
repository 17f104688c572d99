// SPDX-License-Identifier: Apache-2.0
import { rotationErrors, translationErrors } from './errors';
import { apply, motionOf, pointCovariance, rotationCovariance, sigmas } from './pose';
import { kDegPerRad } from './quaternion';
import type { TrackingReport } from './report';
import { kStatuses, type Status } from './status';

type Cell = string | number | null | undefined;

/// RFC 4180; an empty cell for what is not there.
export function csv(header: string[], rows: Cell[][]): string {
  return [header, ...rows].map((row) => row.map(quoted).join(',')).join('\n') + '\n';
}

function quoted(cell: Cell): string {
  if (cell === null || cell === undefined || (typeof cell === 'number' && !Number.isFinite(cell))) return '';
  const text = typeof cell === 'number' ? String(Number(cell.toPrecision(10))) : cell;
  return /[",\n\r]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
}

const kPoseColumns = ['x_mm', 'y_mm', 'z_mm', 'qw', 'qx', 'qy', 'qz', 'point_x_mm', 'point_y_mm', 'point_z_mm',
  'point_sigma_x_mm', 'point_sigma_y_mm', 'point_sigma_z_mm', 'sigma_rx_deg', 'sigma_ry_deg', 'sigma_rz_deg'];

/// Everything that is plotted, a row a frame, body and source; the point is the body's named one.
export function everythingAsCsv(report: TrackingReport): string {
  const rows: Cell[][] = [];
  for (const body of report.bodies) {
    for (const source of ['measured', 'filtered'] as const) {
      if (source === 'filtered' && !body.filtered) continue;
      const poses = source === 'filtered' ? body.filtered! : body.measured;
      const status = source === 'filtered' ? body.filtered_status! : body.status;
      const translation = translationErrors(body, source, 'size');
      const rotation = rotationErrors(body, source, 'size');
      poses.forEach((pose, i) => {
        rows.push([
          report.frames.frame[i], report.frames.time_s[i], body.name, source, kStatuses[status[i] as Status].word,
          ...(pose
            ? [...pose.slice(0, 7), ...apply(motionOf(pose), body.point.position_mm), ...sigmas(pointCovariance(pose)),
              ...sigmas(rotationCovariance(pose)).map((value) => value * kDegPerRad)]
            : kPoseColumns.map(() => null)),
          body.targets_used[i], body.rms_px[i],
          translation.error[i], translation.band[i], rotation.error[i], rotation.band[i],
        ]);
      });
    }
  }
  return csv(['frame', 'time_s', 'body', 'source', 'status', ...kPoseColumns, 'targets', 'rms_px',
    'translation_error_mm', 'translation_band95_mm', 'rotation_error_deg', 'rotation_band95_deg'], rows);
}
