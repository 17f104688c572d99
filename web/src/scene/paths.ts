// SPDX-License-Identifier: Apache-2.0
import { posesOf, statusOf } from '../data/errors';
import { apply, motionOf } from '../data/pose';
import type { Vec3 } from '../data/parts';
import type { BodyTrack } from '../data/report';
import type { Source } from '../data/selection';
import { isMeasured } from '../data/status';

/// The way of the named point between neighbouring frames that both have a pose: measured as a full line,
/// as soon as one end is predicted as a dashed one, gaps where there was none.
export function pathPieces(body: BodyTrack, source: Source): { measured: Vec3[]; predicted: Vec3[] } {
  const status = statusOf(body, source);
  const points = posesOf(body, source).map((row) => row && apply(motionOf(row), body.point.position_mm));
  const measured: Vec3[] = [];
  const predicted: Vec3[] = [];
  for (let i = 1; i < points.length; ++i) {
    const [from, to] = [points[i - 1], points[i]];
    if (!from || !to) continue;
    (isMeasured(status[i - 1]) && isMeasured(status[i]) ? measured : predicted).push(from, to);
  }
  return { measured, predicted };
}
