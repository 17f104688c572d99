// SPDX-License-Identifier: Apache-2.0

/// What base64 text holds, as bytes.
export function bytesOf(base64: string): DataView {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return new DataView(bytes.buffer);
}

/// Lowest byte first whatever the machine.
export function floatsOf(base64: string): Float32Array {
  const view = bytesOf(base64);
  return Float32Array.from({ length: view.byteLength / 4 }, (_, i) => view.getFloat32(4 * i, true));
}

export function countsOf(base64: string): Uint32Array {
  const view = bytesOf(base64);
  return Uint32Array.from({ length: view.byteLength / 4 }, (_, i) => view.getUint32(4 * i, true));
}

export function shortsOf(base64: string): Uint16Array {
  const view = bytesOf(base64);
  return Uint16Array.from({ length: view.byteLength / 2 }, (_, i) => view.getUint16(2 * i, true));
}

export function signedBytesOf(base64: string): Int8Array {
  return new Int8Array(bytesOf(base64).buffer);
}

/// A bit each, the lowest of a byte first; as many as there is room for, which may be a few more than are meant.
export function bitsOf(base64: string): Uint8Array {
  const view = bytesOf(base64);
  return Uint8Array.from({ length: 8 * view.byteLength }, (_, i) => (view.getUint8(i >> 3) >> (i & 7)) & 1);
}

/// IEEE 754 half precision: sign, five bits of exponent, ten of fraction.
export function halfOf(bits: number): number {
  const sign = bits & 0x8000 ? -1 : 1;
  const exponent = (bits >> 10) & 0x1f;
  const fraction = bits & 0x3ff;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return sign * (exponent === 0 ? fraction * 2 ** -24 : (1 + fraction / 1024) * 2 ** (exponent - 15));
}
