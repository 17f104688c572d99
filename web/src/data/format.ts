// SPDX-License-Identifier: Apache-2.0
const kThin = '\u202f';
const kMinus = '\u2212';

/// A count with thin spaces between thousands.
export function count(value: number): string {
  return Math.round(value).toString().replace(/\B(?=(\d{3})+$)/g, kThin);
}

/// So many significant digits, never in exponent form; a dash for what is not there.
export function significant(value: number | null | undefined, digits = 3): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return '–';
  if (value === 0) return '0';
  const magnitude = Math.floor(Math.log10(Math.abs(Number(value.toPrecision(digits)))));
  return decimals(value, Math.max(0, digits - 1 - magnitude));
}

export function decimals(value: number | null | undefined, places: number): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return '–';
  const text = Math.abs(value).toFixed(Math.min(12, places));
  return value < 0 && Number(text) !== 0 ? kMinus + text : text;
}

/// Nothing at all and everything are said exactly; between them no rounding may pretend either.
export function percent(part: number): string {
  if (part <= 0) return '0';
  if (part >= 1) return '100';
  return Math.min(99.9, Math.max(0.1, part * 100)).toFixed(1);
}

/// The largest of 1, 2, 5 times a power of ten that is not above the value.
export function roundStep(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  const lead = value / power;
  return power * (lead >= 5 - 1e-9 ? 5 : lead >= 2 - 1e-9 ? 2 : 1);
}

export function times(factor: number): string {
  return factor >= 1 ? count(factor) : String(factor);
}
