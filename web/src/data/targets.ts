// SPDX-License-Identifier: Apache-2.0
import type { BodyTrack, Sightings } from './report';
import { isMeasured } from './status';

type Residuals = ([number, number] | null)[];

export interface CameraResidual {
  rms: number | null;                // px, both axes together per axis
  mean: [number, number] | null;     // px: a lasting offset is no noise
}

/// How often a target was seen in the frames whose pose was measured, and how far from where the pose puts it.
export interface TargetSummary {
  frames: number;
  both: number;  // shares of those frames
  left: number;
  right: number;
  hidden: number;
  leftResidual: CameraResidual;
  rightResidual: CameraResidual;
}

export function summariseTarget(body: BodyTrack, sightings: Sightings): TargetSummary {
  const counts = [0, 0, 0, 0];
  for (let i = 0; i < sightings.seen.length; ++i) if (isMeasured(body.status[i])) ++counts[Number(sightings.seen[i])];
  const frames = counts[0] + counts[1] + counts[2] + counts[3];
  const share = (k: number) => (frames > 0 ? counts[k] / frames : 0);
  return {
    frames, hidden: share(0), left: share(1), right: share(2), both: share(3),
    leftResidual: residualOf(sightings.left_px), rightResidual: residualOf(sightings.right_px),
  };
}

function residualOf(residuals: Residuals): CameraResidual {
  let n = 0;
  let [x, y, squares] = [0, 0, 0];
  for (const residual of residuals) {
    if (!residual) continue;
    ++n;
    x += residual[0];
    y += residual[1];
    squares += residual[0] ** 2 + residual[1] ** 2;
  }
  if (n === 0) return { rms: null, mean: null };
  return { rms: Math.sqrt(squares / (2 * n)), mean: [x / n, y / n] };
}
