// SPDX-License-Identifier: Apache-2.0
import type { CellReport } from '../data/cell_report';
import type { CellSelection } from '../data/cell_selection';
import { decimals, percent } from '../data/format';
import type { Shared } from '../data/selection';
import { reasonShares, seenCode, sightRuns, sightSentence } from '../data/sight';
import { h } from '../dom';
import { seenBy, type Seen } from '../scene/marks';
import { stripView } from './strip';

/// How a target that is seen by both cameras, by one, by none is told in strips and views.
export const kSeenColours: Record<Seen, string> = { both: '--seen-both', one: '--seen-one', hidden: '--seen-none' };
const kHeights: Record<Seen, number> = { both: 0.3, one: 0.65, hidden: 1 };
const kWords: Record<Seen, string> = { both: 'seen by both cameras', one: 'by one', hidden: 'by none' };

/// Each target of a body over the motion, and in words why cameras do not see it: of the one pointed at, else
/// of all in the present frame.
export function sightStrip(report: CellReport, body: number, axis: number[], shared: Shared<CellSelection>): { element: HTMLElement; redraw: () => void } {
  const { targets, sight, name } = report.bodies[body];
  let pointed: number | null = null;
  const words = h('p', { class: 'note sight-words', 'aria-live': 'polite' });
  const tell = () => {
    const { frame } = shared.now;
    const places = pointed !== null ? [pointed] : targets.map((_, i) => i).filter((i) => seenCode(sight[i], frame) !== '3');
    const told = sightSentence(report.bodies[body], places, frame, report.solids);
    words.textContent = `At ${decimals(report.time_s[frame], 2)} s: ${told || 'both cameras see every target'}.`;
  };
  const strip = stripView({
    id: 'sight', title: `Targets of ${name}, and why cameras do not see them`, axis, shared,
    words: `Visibility of each target over time. ${targets.map((target, i) => `${target.id}: ${percent(share(sight[i]))} % of the frames seen by both cameras`).join('. ')}`,
    rows: targets.map((target, i) => ({
      label: target.id,
      runs: sightRuns(sight[i]).map(({ code, first, last }) => ({ first, last, colour: kSeenColours[seenBy(code)], height: kHeights[seenBy(code)], quiet: code === '3' })),
    })),
    key: h('span', { class: 'status-key' }, ...(Object.keys(kWords) as Seen[]).map((seen) =>
      h('span', { class: 'key block', style: `--key: var(${kSeenColours[seen]}); --tall: ${kHeights[seen]}` }, h('i'), kWords[seen]))),
    point: (row) => {
      pointed = row;
      tell();
    },
  });
  shared.watch((now, before) => now.frame !== before.frame && tell());
  tell();
  const reasons = reasonShares(report.bodies[body], report.solids).slice(0, 5).map(({ words: reason, share: part }) => `${reason} ${percent(part)} %`);
  strip.element.append(words, h('p', { class: 'note' }, reasons.length > 0 ? `Of all lines of sight over the motion: ${reasons.join(', ')}.` : 'No line of sight is ever broken.'));
  return strip;
}

function share([left, right]: [string, string]): number {
  let both = 0;
  for (let i = 0; i < left.length; ++i) if (left[i] === '.' && right[i] === '.') ++both;
  return left.length > 0 ? both / left.length : 0;
}
