// Round numbers and units for people.

const digits = [1, 2, 5, 10];

/// The largest of 1, 2, 5 times a power of ten that is at most `limit`.
export function niceLength(limit: number): number {
  const power = 10 ** Math.floor(Math.log10(limit));
  return power * (digits.findLast((digit) => digit * power <= limit) ?? 1);
}

/// The smallest of these numbers that is at least `value`; 0 of 0.
export function roundUp(value: number): number {
  if (!(value > 0)) return 0;
  const power = 10 ** Math.floor(Math.log10(value));
  return power * digits.find((digit) => digit * power >= value)!;
}

/// A quantity with three digits and a prefix of its unit.
export function withUnit(value: number, unit: string): string {
  const prefixes = ["\u00b5", "m", "", "k", "M", "G"];
  const power = Math.min(3, Math.max(-2, Math.floor(Math.log10(Math.abs(value) || 1) / 3)));
  return `${Number((value / 1000 ** power).toPrecision(3))} ${prefixes[power + 2]}${unit}`;
}
