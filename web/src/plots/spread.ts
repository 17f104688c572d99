// SPDX-License-Identifier: Apache-2.0

/// Places moved as little as needed so that each is at least `gap` from the next: names at a plot's side do not
/// cover one another.
export function apart(wanted: number[], gap: number): number[] {
  const order = wanted.map((_, i) => i).sort((a, b) => wanted[a] - wanted[b] || a - b);
  // Runs of names that touch stand about their mean; a run that then meets its neighbour joins it.
  const runs: { sum: number; names: number[] }[] = [];
  const first = ({ sum, names }: { sum: number; names: number[] }) => sum / names.length - (gap * (names.length - 1)) / 2;
  for (const i of order) {
    runs.push({ sum: wanted[i], names: [i] });
    while (runs.length > 1) {
      const [before, last] = runs.slice(-2);
      if (first(before) + gap * before.names.length <= first(last)) break;
      runs.splice(-2, 2, { sum: before.sum + last.sum, names: [...before.names, ...last.names] });
    }
  }
  const places = [...wanted];
  for (const run of runs) run.names.forEach((i, k) => (places[i] = first(run) + gap * k));
  return places;
}
