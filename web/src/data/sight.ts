// SPDX-License-Identifier: Apache-2.0
import type { CellBody, CellSolid } from './cell_report';

const kReasons: Record<string, string> = {
  B: 'behind the camera', V: 'outside the working volume', O: 'too oblique', I: 'outside the image', S: 'too small in the image', C: 'too close to another target',
};

export const kSides = ['left', 'right'] as const;

/// The solid that hides a target from a camera, by its place; null when none does. A `z` tells no place.
export function hiderOf(letter: string): number | null {
  return letter >= 'a' && letter <= 'y' ? letter.charCodeAt(0) - 97 : null;
}

/// Why a camera does not see a target: "hidden by casing".
export function sightWords(letter: string | undefined, solids: Pick<CellSolid, 'name'>[]): string {
  if (letter === '.') return 'seen';
  if (letter === undefined) return 'not told';
  const hider = hiderOf(letter);
  if (hider !== null) return `hidden by ${solids[hider]?.name ?? `solid ${hider + 1}`}`;
  return letter === 'z' ? 'hidden by another solid' : kReasons[letter] ?? `not seen (${letter})`;
}

/// 0 hidden, 1 left, 2 right, 3 both: as in a tracking report.
export function seenCode([left, right]: [string, string], frame: number): '0' | '1' | '2' | '3' {
  return String((left[frame] === '.' ? 1 : 0) + (right[frame] === '.' ? 2 : 0)) as '0' | '1' | '2' | '3';
}

/// How both cameras see a target, as words that follow its name: "hidden by casing for the left camera".
export function targetWords(body: CellBody, target: number, frame: number, solids: Pick<CellSolid, 'name'>[]): string {
  const [left, right] = [0, 1].map((side) => sightWords(body.sight[target][side][frame], solids));
  if (left === right) return left === 'seen' ? 'seen by both cameras' : `${left} for both cameras`;
  return [left, right].flatMap((words, side) => (words === 'seen' ? [] : [`${words} for the ${kSides[side]} camera`])).join(', ');
}

/// The same of several targets, those of a kind together: "P1, P2 too oblique for both cameras; P4 …".
export function sightSentence(body: CellBody, targets: number[], frame: number, solids: Pick<CellSolid, 'name'>[]): string {
  const groups = new Map<string, string[]>();
  for (const target of targets) {
    const words = targetWords(body, target, frame, solids);
    groups.set(words, [...(groups.get(words) ?? []), body.targets[target].id]);
  }
  return [...groups].map(([words, ids]) => `${ids.join(', ')} ${words}`).join('; ');
}

export interface SightRun {
  code: '0' | '1' | '2' | '3';
  first: number;
  last: number;  // inclusive
}

/// Stretches of frames in which a target is seen by the same cameras.
export function sightRuns(sight: [string, string]): SightRun[] {
  const found: SightRun[] = [];
  for (let i = 0; i < sight[0].length; ++i) {
    const code = seenCode(sight, i);
    const open = found[found.length - 1];
    if (open && open.code === code) open.last = i;
    else found.push({ code, first: i, last: i });
  }
  return found;
}

/// How often each reason keeps a camera from a body's targets, the commonest first; shares of all lines of sight.
export function reasonShares(body: CellBody, solids: Pick<CellSolid, 'name'>[]): { words: string; share: number }[] {
  const counts = new Map<string, number>();
  let all = 0;
  for (const sides of body.sight) {
    for (const letters of sides) {
      all += letters.length;
      for (const letter of letters) if (letter !== '.') counts.set(letter, (counts.get(letter) ?? 0) + 1);
    }
  }
  return [...counts].sort((a, b) => b[1] - a[1]).map(([letter, count]) => ({ words: sightWords(letter, solids), share: count / all }));
}
