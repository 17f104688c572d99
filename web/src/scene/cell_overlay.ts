// SPDX-License-Identifier: Apache-2.0
import { colour } from '../dom';
import { significant } from '../data/format';
import { ramp } from '../plots/ramp';
import { ticks } from '../plots/svg';
import type { Vec2 } from './stage';

const kHeight = 150;
const kWidth = 13;

export function written(context: CanvasRenderingContext2D, text: string, x: number, y: number, ink: string): void {
  context.lineWidth = 3.5;
  context.lineJoin = 'round';
  context.setLineDash([]);
  context.strokeStyle = colour('--panel');
  context.strokeText(text, x, y);
  context.fillStyle = ink;
  context.fillText(text, x, y);
}

/// The colours of a map with their numbers, at the left bottom; what is allowed as marks beside them.
export function drawColourBar(context: CanvasRenderingContext2D, height: number, [low, high]: [number, number], title: string, limits: { label: string; value: number }[], colourOf: (part: number) => string = ramp): void {
  const left = 16;
  const bottom = height - 18;
  plate(context, left, bottom, title, limits);
  const at = (value: number) => bottom - (high > low ? (value - low) / (high - low) : 0.5) * kHeight;
  for (let i = 0; i < kHeight; ++i) {
    context.fillStyle = colourOf((i + 0.5) / kHeight);
    context.fillRect(left, bottom - i - 1, kWidth, 1.5);
  }
  context.setLineDash([]);
  context.lineWidth = 1;
  context.strokeStyle = colour('--muted');
  context.strokeRect(left - 0.5, bottom - kHeight - 0.5, kWidth + 1, kHeight + 1);
  context.font = '11px system-ui, sans-serif';
  context.textAlign = 'left';
  const marks = ticks(low, high).filter((tick) => at(tick) < bottom - 13 && at(tick) > bottom - kHeight + 13);
  for (const value of [low, ...marks, high]) {
    context.fillStyle = colour('--muted');
    context.fillRect(left + kWidth, at(value) - 0.5, 4, 1);
    written(context, significant(value, 3), left + kWidth + 8, at(value) + 4, colour('--ink'));
  }
  context.font = '600 11px system-ui, sans-serif';
  written(context, title, left, bottom - kHeight - 12, colour('--ink'));
  for (const limit of limits) {
    if (limit.value < low || limit.value > high) continue;
    context.fillStyle = colour('--flag');
    context.fillRect(left - 4, at(limit.value) - 1, kWidth + 8, 2);
    written(context, limit.label, left + kWidth + 52, at(limit.value) + 4, colour('--flag'));
  }
}

/// A ground under the bar and its words, so that what is drawn there does not run through them.
function plate(context: CanvasRenderingContext2D, left: number, bottom: number, title: string, limits: { label: string }[]): void {
  context.font = '600 11px system-ui, sans-serif';
  const wide = Math.max(context.measureText(title).width, 58, ...limits.map(({ label }) => kWidth + 52 + context.measureText(label).width));
  ground(context, left - 8, bottom - kHeight - 28, wide + 16, kHeight + 38);
}

/// Nearly covers what is drawn there.
export function ground(context: CanvasRenderingContext2D, left: number, top: number, width: number, height: number): void {
  context.globalAlpha = 0.84;
  context.fillStyle = colour('--panel');
  context.fillRect(left, top, width, height);
  context.globalAlpha = 1;
}

/// One or two places that were picked, and between them their distance.
export function drawMeasure(context: CanvasRenderingContext2D, places: (Vec2 | null)[], text: string): void {
  const ink = colour('--measure');
  const [a, b] = places;
  if (a && b) {
    for (const [width, stroke] of [[4.5, colour('--panel')], [2, ink]] as const) {
      context.lineWidth = width;
      context.strokeStyle = stroke;
      context.setLineDash([]);
      context.beginPath();
      context.moveTo(...a);
      context.lineTo(...b);
      context.stroke();
    }
  }
  places.forEach((place, i) => {
    if (!place) return;
    for (const [width, stroke] of [[4, colour('--panel')], [2, ink]] as const) {
      context.lineWidth = width;
      context.strokeStyle = stroke;
      context.beginPath();
      context.arc(place[0], place[1], 6, 0, 2 * Math.PI);
      context.stroke();
    }
    context.font = '600 12px system-ui, sans-serif';
    context.textAlign = 'right';
    written(context, 'AB'[i], place[0] - 10, place[1] - 7, ink);
  });
  if (!a || !b) return;
  context.font = '600 13px system-ui, sans-serif';
  context.textAlign = 'center';
  written(context, text, (a[0] + b[0]) / 2, (a[1] + b[1]) / 2 - 8, ink);
}
