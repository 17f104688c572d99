// SPDX-License-Identifier: Apache-2.0
import { count, percent, significant } from './format';
import type { TrackingReport } from './report';
import { kStatuses, runs, type Status } from './status';

/// What went wrong, in words: what the report was given, then what the statuses say, a sentence a body and
/// status.
export function remarksOf(report: TrackingReport): string[] {
  return [...report.remarks, ...statusRemarks(report)];
}

function statusRemarks(report: TrackingReport): string[] {
  const { time_s } = report.frames;
  return report.bodies.flatMap((body) => (['P', 'A', 'L'] as Status[]).flatMap((status) => {
    const stretches = runs(body.status).filter((run) => run.status === status);
    if (stretches.length === 0) return [];
    const frames = stretches.reduce((sum, run) => sum + run.last - run.first + 1, 0);
    const longest = Math.max(...stretches.map((run) => time_s[Math.min(run.last + 1, time_s.length - 1)] - time_s[run.first]));
    const { word, meaning } = kStatuses[status];
    const all = frames === body.status.length;
    return [`${body.name} was ${word} in ${all ? 'all' : `${count(frames)} of`} ${count(body.status.length)} frames${all ? '' : ` (${percent(frames / body.status.length)} %), in ${stretches.length === 1 ? 'one stretch' : `${count(stretches.length)} stretches`}, the longest of ${significant(longest, 2)} s`}: ${meaning}.`];
  }));
}
