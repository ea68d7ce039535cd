// Numbers and units, as the terminal writes them. What was not computed is said, never shown as 0.

const notComputed = 'not computed';

const isNumber = (value) => typeof value === 'number' && Number.isFinite(value);

// 'digits' significant digits, plain where that is short.
function significant(value, digits = 4) {
  if (!isNumber(value)) return notComputed;
  const size = Math.abs(value);
  if (size === 0) return '0';
  if (size >= 1e-3 && size < 1e6) {
    const decimals = digits - 1 - Math.floor(Math.log10(size));
    return value.toFixed(Math.min(12, Math.max(0, decimals)));
  }
  return value.toExponential(digits - 1).replace('e+', 'e');
}

const prefixes = [[1e9, 'G'], [1e6, 'M'], [1e3, 'k'], [1, ''], [1e-3, 'm'], [1e-6, 'µ'], [1e-9, 'n']];
const takesPrefix = new Set(['Pa', 'N', 'm', 's', 'J', 'N/m']);

// The factor and unit in which a value of this size reads well: {factor, unit}.
function readableUnit(value, unit) {
  if (!unit || unit === '-') return {factor: 1, unit: ''};
  const size = Math.abs(value);
  if (!takesPrefix.has(unit) || !isNumber(value) || size === 0 || (size >= 0.1 && size < 1e4))
    return {factor: 1, unit};
  const [base, letter] = prefixes.find(([base]) => size >= base) ?? [1, ''];
  return {factor: 1 / base, unit: letter + unit};
}

function quantity(value, unit, digits = 4) {
  if (!isNumber(value)) return notComputed;
  const readable = readableUnit(value, unit);
  return `${significant(value * readable.factor, digits)} ${readable.unit}`.trim();
}

// Decimals that show two digits of a half width.
function decimalsFor(halfWidth) {
  if (!(halfWidth > 0)) return 3;
  return Math.min(12, Math.max(0, 1 - Math.floor(Math.log10(halfWidth))));
}

function intervalText(pair, factor) {
  if (!Array.isArray(pair) || !isNumber(pair[0]) || !isNumber(pair[1])) return '';
  if (Math.max(...pair.map(Math.abs)) * factor < 1e-3) return pair.map((v) => significant(v * factor)).join(' to ');
  const decimals = decimalsFor(0.5 * Math.abs(pair[1] - pair[0]) * factor);
  return pair.map((v) => (v * factor).toFixed(decimals)).join(' to ');
}

// A setting: without the zeros at its end.
const brief = (value, unit) => {
  if (!isNumber(value)) return notComputed;
  const readable = readableUnit(value, unit);
  return `${Number((value * readable.factor).toPrecision(5))} ${readable.unit}`.trim();
};

const percent = (share, digits = 3) =>
  isNumber(share) ? `${significant(100 * share, digits)} %` : notComputed;

// The unit a column's or key's name ends with, and how to write it; the longest first.
const unitSuffixes = [
  ['_N_m_s_per_rad', 'N m s/rad'], ['_N_m_per_rad', 'N m/rad'], ['_N_s_per_m', 'N s/m'],
  ['_m_per_s2', 'm/s²'], ['_m_per_s', 'm/s'], ['_N_per_m', 'N/m'], ['_N_s', 'N s'], ['_N_m', 'N m'],
  ['_deg', 'deg'], ['_rad', 'rad'], ['_Pa', 'Pa'], ['_kg', 'kg'], ['_m4', 'm⁴'], ['_m2', 'm²'],
  ['_per_s', '1/s'], ['_N', 'N'], ['_J', 'J'], ['_m', 'm'], ['_s', 's'],
];
function splitUnit(name) {
  for (const [suffix, unit] of unitSuffixes) {
    if (name.endsWith(suffix)) return {name: name.slice(0, -suffix.length), unit};
  }
  return {name, unit: ''};
}

// How errors of a channel are shown: lengths in mm.
function errorScale(unit) {
  return unit === 'm' ? {factor: 1e3, unit: 'mm'} : {factor: 1, unit};
}

// The last part of a dotted key with its unit: {name, unit}.
function splitKey(key) {
  const {name, unit} = splitUnit(key.split('.').pop());
  return {name: words(name), unit};
}

const withUnit = (text, unit) => (unit ? `${text} [${unit}]` : text);

const plural = (count, noun) => `${count} ${noun}${count === 1 ? '' : 's'}`;

// 'not_tested' as it reads.
const words = (name) => String(name).replaceAll('_', ' ');
