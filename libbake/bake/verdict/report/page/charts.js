// Error against time and against bytes: a numbered dot per method, the Pareto front as a line.
import { bytes, digits, escaped, seconds } from './text.js';
import { bytes_of, metric_of, time_of } from './metrics.js';
import { state } from './state.js';

const height = 270;
let width = 620; // that of the box on the screen, so that letters have their size
const box = { left: 58, right: 0, top: 16, bottom: height - 46 };

/** A step of 1, 2 or 5 times a power of 10 that cuts a span into about six. */
function even_step(span) {
  const power = 10 ** Math.floor(Math.log10(span / 6));
  return power * [1, 2, 5, 10].find(k => k * power * 6 >= span);
}

/** Marks of a logarithmic axis: even ones over a short span, else 1, 2, 5, 10 ... or 1, 2, 4 ... */
function marks(low, high, base) {
  const ticks = [];
  if (high / low < 5) {
    const unit = base === 2 ? 2 ** (10 * Math.floor(Math.log2(low) / 10)) : 1, step = even_step((high - low) / unit) * unit;
    for (let k = Math.ceil(low / step); k * step <= high; ++k) ticks.push(k * step);
    return ticks;
  }
  const steps = base === 10 && high / low < 200 ? [1, 2, 5] : [1];
  for (let k = Math.floor(Math.log(low) / Math.log(base)); base ** k <= high; ++k)
    for (const step of steps) if (step * base ** k >= low && step * base ** k <= high) ticks.push(step * base ** k);
  const every = Math.ceil(ticks.length / (width < 450 ? 4 : 8));
  return ticks.filter((_, i) => i % every === 0);
}

/** A logarithmic axis from pixel `from` to `to`. Values that are not positive lie on its beginning. */
function axis(values, from, to, base) {
  const positive = values.filter(v => v > 0);
  let low = positive.length ? Math.min(...positive) : 1, high = positive.length ? Math.max(...positive) : 1;
  const widen = Math.max(1.06, (high / low) ** 0.14);
  low /= widen, high *= widen;
  if (positive.length < values.length) low /= 3;
  const span = Math.log(high / low);
  return { at: v => from + (to - from) * (v > 0 ? Math.log(v / low) / span : 0), ticks: marks(low, high, base) };
}

/** The indices of the points that no other beats in both, from left to right. */
export function front(points) {
  const order = points.map((_, i) => i).sort((a, b) => points[a].x - points[b].x || points[a].y - points[b].y);
  let best = Infinity;
  return order.filter(i => points[i].y < best && ((best = points[i].y), true));
}

/** Places of the numbered dots: on their points, or beside them where another dot is. */
function spread(points) {
  const placed = [];
  for (const { px, py } of points) {
    let found = { x: px, y: py };
    search: for (const reach of [0, 24, 40, 60])
      for (let k = 0; k < (reach ? 12 : 1); ++k) {
        const angle = -Math.PI / 2 + (k * Math.PI) / 6, x = px + reach * Math.cos(angle), y = py + reach * Math.sin(angle);
        if (x < box.left + 10 || x > box.right - 10 || y < box.top + 10 || y > box.bottom - 10) continue;
        if (placed.some(p => Math.hypot(p.x - x, p.y - y) < 23)) continue;
        found = { x, y };
        break search;
      }
    placed.push(found);
  }
  return placed;
}

/** On which side of its dot a name has room: 1 right, -1 left, 0 neither. */
function sides(points, places) {
  const taken = places.map(p => ({ x0: p.x - 11, x1: p.x + 11, y0: p.y - 11, y1: p.y + 11 }));
  return points.map(({ name }, i) => {
    for (const side of [1, -1]) {
      const near = places[i].x + side * 14, far = near + side * 6.6 * name.length;
      const r = { x0: Math.min(near, far), x1: Math.max(near, far), y0: places[i].y - 7, y1: places[i].y + 7 };
      if (r.x0 < box.left + 2 || r.x1 > box.right) continue;
      if (taken.some(t => t.x0 < r.x1 && r.x0 < t.x1 && t.y0 < r.y1 && r.y0 < t.y1)) continue;
      taken.push(r);
      return side;
    }
    return 0;
  });
}

function dot(point, place, side, best) {
  const { index, name, px, py, bar } = point;
  const moved = Math.hypot(place.x - px, place.y - py) > 1;
  const chosen = state.method === index;
  const title = `${name}: ${point.error_text}, ${point.cost_text}`;
  let svg = `<g class="dot${best ? ' best' : ''}${chosen ? ' chosen' : ''}" data-index="${index}" tabindex="0" role="button" ` +
    `aria-pressed="${chosen}" aria-label="${escaped(title)}"><title>${escaped(title)}</title>`;
  if (bar) svg += `<line x1="${px}" x2="${px}" y1="${bar[0]}" y2="${bar[1]}"/>`;
  if (moved) svg += `<line x1="${px}" y1="${py}" x2="${place.x}" y2="${place.y}"/><circle cx="${px}" cy="${py}" r="3"/>`;
  svg += `<circle cx="${place.x}" cy="${place.y}" r="10"/><text class="number" x="${place.x}" y="${place.y + 4}">${index}</text>`;
  if (side)
    svg += `<text class="label" x="${place.x + 14 * side}" y="${place.y + 4}" ` +
      `style="text-anchor:${side > 0 ? 'start' : 'end'}">${escaped(name)}</text>`;
  return svg + '</g>';
}

function plot(entries, cost, cost_text, cost_name, base) {
  const metric = metric_of(state.metric);
  const points = entries.flatMap(({ index, name, row }) => {
    const error = row && metric.of(row, state.area), x = row && cost(row);
    return error && x !== undefined ? [{ index, name, x, y: error.value, error }] : [];
  });
  if (!points.length) return '';
  const xs = axis(points.map(p => p.x), box.left, box.right, base);
  const ys = axis(points.map(p => p.y), box.bottom, box.top, 10);
  for (const p of points) {
    p.px = Math.round(xs.at(p.x) * 10) / 10, p.py = Math.round(ys.at(p.y) * 10) / 10;
    p.error_text = `${metric.name} ${digits(p.y)}` + (p.error.error ? ` ± ${digits(p.error.error, 1)}` : '');
    p.cost_text = cost_text(p.x);
    if (p.error.error && p.y > 0)
      p.bar = [p.y - p.error.error, p.y + p.error.error].map(v => Math.max(box.top, Math.min(box.bottom, ys.at(v))));
  }
  const best = front(points);
  const places = spread(points), names = sides(points, places);
  let svg = `<svg viewBox="0 0 ${width} ${height}" role="group" aria-label="${escaped(metric.name)} against ${cost_name}">`;
  for (const t of xs.ticks) {
    const x = xs.at(t);
    svg += `<line class="grid" x1="${x}" x2="${x}" y1="${box.top}" y2="${box.bottom}"/>` +
      `<text class="tick" x="${x}" y="${box.bottom + 18}" text-anchor="middle">${cost_text(t)}</text>`;
  }
  for (const t of ys.ticks) {
    const y = ys.at(t);
    svg += `<line class="grid" x1="${box.left}" x2="${box.right}" y1="${y}" y2="${y}"/>` +
      `<text class="tick" x="${box.left - 8}" y="${y + 4}" text-anchor="end">${digits(t)}</text>`;
  }
  svg += `<text class="axis" x="${(box.left + box.right) / 2}" y="${height - 8}" text-anchor="middle">${cost_name}</text>` +
    `<text class="axis" transform="translate(14 ${(box.top + box.bottom) / 2}) rotate(-90)" text-anchor="middle">${escaped(metric.name)}</text>` +
    `<polyline class="front" points="${best.map(i => points[i].px + ',' + points[i].py).join(' ')}"/>`;
  points.forEach((p, i) => (svg += dot(p, places[i], names[i], best.includes(i))));
  return svg + '</svg>';
}

/** Draws both charts of entries {index, name, row} anew. */
export function draw_charts(entries, time_box, bytes_box) {
  width = Math.max(300, time_box.clientWidth || width), box.right = width - 16;
  const focus = document.activeElement?.closest?.('.dot');
  const where = focus && [focus.closest('figure').id, focus.dataset.index];
  time_box.innerHTML = plot(entries, time_of, seconds, 'time to prepare and to render', 10);
  bytes_box.innerHTML = plot(entries, bytes_of, bytes, 'memory', 2);
  // A key on a dot chooses it; the dot that replaces it keeps the focus.
  if (where) document.querySelector(`#${where[0]} [data-index="${where[1]}"]`)?.focus();
}
