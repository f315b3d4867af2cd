// Numbers as people read them: SI prefixes in steps of a thousand, four digits.

const PREFIXES = [
    [1e9, "G"], [1e6, "M"], [1e3, "k"], [1, ""], [1e-3, "m"], [1e-6, "µ"], [1e-9, "n"],
];

/** SI prefix for the largest of some values: `{ factor, unit }`. */
export function scaleFor(largest, unit) {
    const size = Math.abs(largest);
    if (!(size > 0) || !Number.isFinite(size)) return { factor: 1, unit };
    const [factor, prefix] = PREFIXES.find(([factor]) => size >= factor * 0.9995) ?? PREFIXES[PREFIXES.length - 1];
    return { factor, unit: prefix + unit };
}

/** Four significant digits, without an exponent where it can be helped. */
export function digits(value, count = 4) {
    if (!Number.isFinite(value)) return "–";
    if (value === 0) return "0";
    const size = Math.abs(value);
    if (size >= 1e6 || size < 1e-4) return value.toExponential(count - 1).replace("-", "−").replace("e+", "e");
    const decimals = Math.max(0, count - 1 - Math.floor(Math.log10(size)));
    return value.toFixed(Math.min(decimals, 6)).replace("-", "−");
}

/** Number with fixed decimals; a value that rounds to zero has no sign. */
export function fixed(value, decimals) {
    const text = value.toFixed(decimals);
    return Number(text) === 0 ? text.replace("-", "") : text.replace("-", "−");
}

/** A value with its unit and a suitable prefix: `1.250 kN`. */
export function quantity(value, unit, count = 4) {
    if (!Number.isFinite(value)) return "–";
    const scale = scaleFor(value, unit);
    return `${digits(value / scale.factor, count)} ${scale.unit}`;
}

/** Decimals that tell two neighbouring times apart, 0 to 6. */
export function decimalsFor(step) {
    if (!(step > 0)) return 3;
    return Math.min(6, Math.max(0, Math.ceil(-Math.log10(step) - 1e-9)));
}

/** Round steps of an axis: 1, 2 or 5 times a power of ten, about `count` of them. */
export function niceStep(span, count) {
    const rough = span / Math.max(1, count);
    const power = 10 ** Math.floor(Math.log10(rough));
    const mantissa = rough / power;
    return power * (mantissa <= 1 ? 1 : mantissa <= 2 ? 2 : mantissa <= 5 ? 5 : 10);
}

/** `1,234`: counts with separators. */
export const count = (number) => number.toLocaleString("en");
