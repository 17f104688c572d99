// SPDX-License-Identifier: Apache-2.0
export type Status = 'O' | 'P' | 'R' | 'A' | 'L';

export interface StatusWords {
  word: string;
  meaning: string;
  colour: string;  // a custom property of the style sheet
  height: number;  // of its mark in the status strip: told by more than colour, trouble tallest
}

export const kStatuses: Record<Status, StatusWords> = {
  O: { word: 'OK', meaning: 'four or more targets seen by both cameras', colour: '--ok', height: 0.35 },
  P: { word: 'PARTIAL', meaning: 'fewer than four seen by both, yet the pose is fully determined', colour: '--partial', height: 0.55 },
  R: { word: 'PREDICTED', meaning: 'not measured in this frame; carried on by the filter', colour: '--predicted', height: 0.7 },
  A: { word: 'AMBIGUOUS', meaning: 'another labelling of the targets fits as well; no pose is given', colour: '--ambiguous', height: 0.85 },
  L: { word: 'LOST', meaning: 'not found; no pose is given', colour: '--lost', height: 1 },
};

export function isMeasured(status: string): boolean {
  return status === 'O' || status === 'P';
}

export interface Run {
  status: Status;
  first: number;  // index of a frame
  last: number;   // inclusive
}

/// A status string as runs of equal status.
export function runs(letters: string): Run[] {
  const found: Run[] = [];
  for (let i = 0; i < letters.length; ++i) {
    const status = letters[i] as Status;
    const open = found[found.length - 1];
    if (open && open.status === status) open.last = i;
    else found.push({ status, first: i, last: i });
  }
  return found;
}

export function share(letters: string, status: Status): number {
  if (letters.length === 0) return 0;
  let count = 0;
  for (const letter of letters) if (letter === status) ++count;
  return count / letters.length;
}
