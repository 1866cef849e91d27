// Numbers as text.

export function digits(value, count = 3) {
  if (value === 0) return '0';
  const size = Math.abs(value);
  return size >= 1e5 || size < 1e-4 ? value.toExponential(count - 1) : String(Number(value.toPrecision(count)));
}

export function seconds(value) {
  if (value < 1) return digits(value * 1000) + ' ms';
  return value < 100 ? digits(value) + ' s' : digits(value / 60) + ' min';
}

export function bytes(value) {
  let unit = 0;
  for (; value >= 1024 && unit < 4; ++unit) value /= 1024;
  return digits(value) + ' ' + ['B', 'KiB', 'MiB', 'GiB', 'TiB'][unit];
}

/** Text for HTML and SVG. */
export function escaped(text) {
  return String(text).replace(/[&<>"]/g, c => `&#${c.charCodeAt(0)};`);
}
