// SPDX-License-Identifier: Apache-2.0
import { countSeen, type LayoutReport } from '../data/layout';
import type { LayoutSelection } from '../data/layout_selection';
import { axisOf } from '../data/selection';
import type { Figure, Trace } from './figures';

/// The chosen layout over the motion, and dashed the one it is compared with.
export function motionFigures(report: LayoutReport, now: LayoutSelection): Figure[] {
  const { time_s } = report.motion;
  const axis = axisOf({ frame: time_s.map((_, i) => i), time_s });
  const chosen = report.layouts[now.layout];
  const other = now.against !== null && now.against !== now.layout ? report.layouts[now.against] : null;
  const seen: Trace[] = [{ label: chosen.name, values: countSeen(chosen), colour: '--body-1', form: 'steps' }];
  const errors: Trace[] = [
    { label: `${chosen.name}, all targets there`, values: chosen.error_mm, colour: '--body-1', form: 'line' },
    { label: `${chosen.name}, after the worst loss`, values: chosen.error_lost_mm, colour: '--flag', form: 'line' },
  ];
  if (other) {
    seen.push({ label: other.name, values: countSeen(other), colour: '--body-2', form: 'steps', dashed: true });
    errors.push({ label: `${other.name}, all targets there`, values: other.error_mm, colour: '--body-2', form: 'line', dashed: true });
  }
  return [
    { id: 'seen', title: 'Targets that both cameras see, over the motion', unit: 'count', axis, bands: [], fromZero: true, digits: 0, traces: seen, note: 'four are needed to be sure of a pose' },
    { id: 'error', title: 'Predicted error at the work points, over the motion', unit: 'mm', axis, bands: [], fromZero: true, digits: 3, traces: errors, note: 'largest over the work points, √tr Σ; a gap: the pose is not determined there' },
  ];
}

/// How the search went.
export function historyFigures(report: LayoutReport): Figure[] {
  const { history } = report;
  const axis = { label: 'candidates evaluated', values: history.map((record) => record.evaluations) };
  const figure = (id: string, title: string, unit: string, values: (number | null)[], note: string): Figure => ({
    id, title, unit, axis, bands: [], fromZero: true, digits: 3, group: 'history', note,
    traces: [{ label: title.toLowerCase(), values, colour: '--accent', form: 'line' }],
  });
  return [
    figure('hypervolume', 'Hypervolume', '', history.map((record) => record.hypervolume), 'what the front dominates: once it stays level, more searching brings little'),
    figure('feasible', 'Feasible candidates', '%', history.map((record) => 100 * record.feasible_share), 'share of the population that holds all constraints'),
  ];
}
