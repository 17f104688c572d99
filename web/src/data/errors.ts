// SPDX-License-Identifier: Apache-2.0
import { kNormal95, lengthBound95 } from './bands';
import { apply, motionOf, pointCovariance, rotationCovariance, sigmas, subtract, type Covariance } from './pose';
import { conjugate, kDegPerRad, product, rotationVector } from './quaternion';
import type { Vec3 } from './parts';
import type { BodyTrack, PoseRow } from './report';
import type { Component, Source } from './selection';
import { largest, mean, present, quantile, rms, type Column } from './statistics';

/// Measured less true, and the half-width of the stated 95 % band, frame by frame.
export interface Errors {
  error: Column;
  band: Column;
}

const kAxis: Record<Exclude<Component, 'size'>, number> = { x: 0, y: 1, z: 2 };

export function posesOf(body: BodyTrack, source: Source): (PoseRow | null)[] {
  return source === 'filtered' && body.filtered ? body.filtered : body.measured;
}

export function statusOf(body: BodyTrack, source: Source): string {
  return source === 'filtered' && body.filtered_status ? body.filtered_status : body.status;
}

function component(vector: Vec3, which: Component): number {
  return which === 'size' ? Math.hypot(...vector) : vector[kAxis[which]];
}

function bound(covariance: Covariance, which: Component): number {
  return which === 'size' ? lengthBound95(covariance) : kNormal95 * sigmas(covariance)[kAxis[which]];
}

/// Of the body's named point, mm along the tracker's axes.
export function translationErrors(body: BodyTrack, source: Source, which: Component): Errors {
  const poses = posesOf(body, source);
  const point = body.point.position_mm;
  return {
    error: poses.map((row, i) => {
      const truth = body.truth?.[i];
      if (!row || !truth) return null;
      return component(subtract(apply(motionOf(row), point), apply(motionOf(truth), point)), which);
    }),
    band: poses.map((row) => (row ? bound(pointCovariance(row), which) : null)),
  };
}

/// Rotation vector, degrees along the tracker's axes.
export function rotationErrors(body: BodyTrack, source: Source, which: Component): Errors {
  const poses = posesOf(body, source);
  return {
    error: poses.map((row, i) => {
      const truth = body.truth?.[i];
      if (!row || !truth) return null;
      const turn = product(motionOf(row).rotation, conjugate(motionOf(truth).rotation));
      return component(rotationVector(turn), which) * kDegPerRad;
    }),
    band: poses.map((row) => (row ? bound(rotationCovariance(row), which) * kDegPerRad : null)),
  };
}

export interface ErrorSummary {
  frames: number;
  mean: number | null;
  rms: number | null;
  p95: number | null;
  max: number | null;
  inside: number | null;  // share of errors inside their band
  band: number | null;    // the median of what was stated
}

export function summarise({ error, band }: Errors): ErrorSummary {
  const sizes = present(error).map(Math.abs);
  const both = error.map((value, i) => (value === null || band[i] === null ? null : Math.abs(value) <= band[i]! ? 1 : 0));
  return {
    frames: sizes.length,
    mean: mean(sizes),
    rms: rms(sizes),
    p95: quantile(sizes, 0.95),
    max: largest(sizes),
    inside: mean(present(both)),
    band: quantile(present(band), 0.5),
  };
}

/// The way from the first pose: of the named point (mm) and of the attitude (deg, rotation vector).
export function displacements(body: BodyTrack, source: Source): { translation: (Vec3 | null)[]; rotation: (Vec3 | null)[] } {
  const start = body.measured.find((row) => row !== null);
  if (!start) return { translation: body.measured.map(() => null), rotation: body.measured.map(() => null) };
  const first = motionOf(start);
  const at = apply(first, body.point.position_mm);
  const poses = posesOf(body, source);
  return {
    translation: poses.map((row) => row && subtract(apply(motionOf(row), body.point.position_mm), at)),
    rotation: poses.map((row) => row && scaled(rotationVector(product(motionOf(row).rotation, conjugate(first.rotation))), kDegPerRad)),
  };
}

function scaled([x, y, z]: Vec3, factor: number): Vec3 {
  return [x * factor, y * factor, z * factor];
}
