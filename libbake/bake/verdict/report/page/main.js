// The page of a report: joins the figures of the JSON, the pictures and the controls.
import { draw_charts } from './charts.js';
import { metric_of, metrics_in } from './metrics.js';
import { draw_ramp, find_pictures, is_loaded, load, values } from './pictures.js';
import { change, hash, listen, modes, start, state } from './state.js';
import { digits, escaped, seconds } from './text.js';
import { make_viewer } from './viewer.js';

const $ = id => document.getElementById(id);
const data = JSON.parse($('data').textContent);
const report = data.report;
const views = Array.isArray(report.views) && report.views.length ? report.views : [report]; // one per camera
const rows_of = view => (Array.isArray(view.methods) ? view.methods : []);
const all_rows = views.flatMap(rows_of);
const pictures = find_pictures(data);

/** Entry i of a view is chosen by key i: the reference, then the methods. */
const all_entries = views.map((view, k) => {
  const own = pictures.filter(picture => picture.view === k);
  return [
    { index: 0, name: view.reference?.method ?? own[0]?.method ?? 'reference', row: undefined, picture: own[0] },
    ...rows_of(view).map((row, i) => ({
      index: i + 1,
      name: row.method ?? '?',
      row,
      picture: own.slice(1).find(picture => picture.method === row.method),
    })),
  ];
});
let entries = all_entries[0]; // those of the camera that is chosen
const first_exposure = Number(report.exposure) || 0;
const error_of = entry => entry.row && metric_of(state.metric).of(entry.row, state.area);
let point; // the pixel below the pointer
let last_method = 1;

const viewer = make_viewer($('frame'), $('canvas'), at => {
  point = at;
  write_values();
});

/** The picture that is chosen, once it is decoded; until then the old one stays. */
function show_picture() {
  const entry = entries[state.method], reference = entries[0].picture;
  if (!entry.picture) {
    viewer.show({ names: [] });
    return write_rest();
  }
  const needed = [[entry.picture, 'shown']];
  if (state.mode === 'wipe' && reference) needed.push([reference, 'shown']);
  if (state.mode === 'error') needed.push([entry.picture, 'errors']);
  if (!needed.every(part => is_loaded(...part))) {
    Promise.all(needed.map(part => load(...part))).then(show_picture);
    return;
  }
  viewer.show({
    reference, chosen: entry.picture, names: [entries[0].name + ' (reference)', entry.index + ' · ' + entry.name],
    region: entry.row?.worst,
  });
  write_values();
  write_scale();
  if (!performance.getEntriesByName('first-picture').length) {
    performance.mark('first-picture');
    setTimeout(() => {
      write_rest();
      load_rest();
    });
  }
}

async function load_rest() {
  for (const what of ['shown', 'errors']) for (const picture of pictures) await load(picture, what);
  document.documentElement.dataset.loaded = 'all';
}

function write_values() {
  const entry = entries[state.method], reference = entries[0].picture;
  const line = (name, texts) => `<tr><th>${escaped(name)}</th>${texts.map(t => `<td>${t}</td>`).join('')}</tr>`;
  const wanted = [[reference, 'shown'], [entry.picture, 'shown'], [entry.picture, 'errors']];
  if (point && entry.picture && reference && !wanted.every(part => is_loaded(...part))) {
    Promise.all(wanted.map(part => load(...part))).then(write_values);
    return;
  }
  if (!point || !entry.picture || !reference) {
    $('values').innerHTML = line('Point at a pixel for its radiance (linear RGB)', []);
    return;
  }
  const of = picture => values(picture, point.x, point.y, 1, 1);
  const a = of(reference), b = of(entry.picture);
  let text = line(`pixel ${point.x}, ${point.y}`, ['R', 'G', 'B', ...(b.errors ? ['FLIP'] : [])]);
  text += line('reference', a.light[0].map(v => digits(v)));
  if (entry.index) {
    text += line(entry.name, [...b.light[0].map(v => digits(v)), ...(b.errors ? [b.errors[0].toFixed(3)] : [])]);
    text += line('difference', b.light[0].map((v, c) => (v < a.light[0][c] ? '−' : '+') + digits(Math.abs(v - a.light[0][c]), 2)));
  }
  $('values').innerHTML = text;
}

function write_list() {
  const most = Math.max(...entries.map(e => error_of(e)?.value ?? 0), 1e-30);
  $('methods').innerHTML = entries.map(entry => {
    const error = error_of(entry);
    return `<li><button data-index="${entry.index}" aria-pressed="${entry.index === state.method}"><kbd>${entry.index}</kbd>` +
      `<span>${escaped(entry.name)}</span><span class="value">${entry.index ? (error ? digits(error.value) : '') : 'reference'}</span>` +
      (error ? `<span class="meter" style="width:${(100 * error.value) / most}%"></span>` : '') + '</button></li>';
  }).join('');
}

/** What the report says of an entry, in one line. */
function summary(entry) {
  const cost = entry.row ?? views[state.view].reference ?? {};
  const texts = [];
  const error = error_of(entry);
  if (error) texts.push(`${metric_of(state.metric).name} ${digits(error.value)}` + (error.error ? ` ± ${digits(error.error, 1)}` : ''));
  if (typeof cost.prepare_seconds === 'number') texts.push(`${seconds(cost.prepare_seconds)} to prepare`);
  if (typeof cost.render_seconds === 'number') texts.push(`${seconds(cost.render_seconds)} to render`);
  if (!entry.index && cost.note) texts.push(cost.note);
  return texts.join(' · ');
}

function write_chosen() {
  const entry = entries[state.method], region = entry.row?.worst;
  const command = entry.row?.command ?? (entry.index ? '' : report.command) ?? '';
  $('name').textContent = entry.name + (entry.index ? '' : ' (reference)');
  $('summary').textContent = summary(entry);
  $('command').textContent = command;
  $('command').hidden = $('copy').hidden = !command;
  $('worst').disabled = !region;
  $('place').textContent = region ? `Worst region: ${region.width} × ${region.height} pixels at ${region.x}, ${region.y}` : '';
  for (const marked of document.querySelectorAll('main [data-method]'))
    marked.classList.toggle('chosen', entry.index > 0 && marked.dataset.method === entry.name);
}

const write_scale = () => ($('scale').textContent = digits(100 * viewer.scale() * devicePixelRatio, 3) + ' %');

function write_controls() {
  for (const button of document.querySelectorAll('[data-mode]'))
    button.setAttribute('aria-pressed', button.dataset.mode === state.mode);
  $('fit').setAttribute('aria-pressed', state.zoom === 0);
  $('exposure').value = state.exposure;
  $('stops').textContent = (state.exposure > 0 ? '+' : '') + digits(state.exposure);
  $('reset').disabled = state.exposure === first_exposure;
  $('wipe').value = Math.round(state.wipe * 1000);
  $('wiping').hidden = state.mode !== 'wipe' || !state.method;
  $('wiped').textContent = entries[state.method].name;
  $('legend').hidden = state.mode !== 'error' || !state.method;
  $('marker').checked = state.marker;
  $('view').value = state.view;
  $('metric').value = metric_of(state.metric).key;
  $('area').value = state.area;
}

let drawn = '';
function update() {
  state.view = Math.min(state.view, views.length - 1);
  entries = all_entries[state.view];
  state.method = Math.min(state.method, entries.length - 1);
  if (state.method) last_method = state.method;
  write_controls();
  show_picture();
  if (performance.getEntriesByName('first-picture').length) write_rest();
}

/** Everything but the picture and its controls. It waits for the first picture, and panning leaves it as it is. */
function write_rest() {
  const now = [state.view, state.method, state.metric, state.area].join();
  if (now === drawn) return;
  drawn = now;
  write_list();
  write_chosen();
  $('charts').hidden = false;
  draw_charts(entries, $('time'), $('bytes'));
  $('charts').hidden = !document.querySelector('#plots svg');
}

const choose = (index, view = state.view) => index < entries.length && change({ method: index, view });
const next = step => choose((state.method + step + entries.length) % entries.length);
const expose = exposure => change({ exposure: Math.min(Number($('exposure').max), Math.max(Number($('exposure').min), exposure)) });
const worst = () => entries[state.method].row?.worst && viewer.jump(entries[state.method].row.worst);

/** Copies a text and says so on the button. Where the page may not, the text is selected instead. */
async function copy(text, button) {
  const label = button.textContent;
  try {
    await navigator.clipboard.writeText(text);
    button.textContent = 'Copied';
  } catch {
    const field = document.createElement('textarea');
    field.value = text;
    document.body.append(field);
    field.select();
    button.textContent = document.execCommand('copy') ? 'Copied' : 'Not copied';
    field.remove();
  }
  setTimeout(() => (button.textContent = label), 1200);
}

function wire() {
  $('exposure').min = first_exposure - 8, $('exposure').max = first_exposure + 8;
  draw_ramp($('ramp'));
  const click = (id, work) => $(id).addEventListener('click', work);
  click('out', () => viewer.zoom(1 / 2));
  click('in', () => viewer.zoom(2));
  click('fit', viewer.fit);
  click('one', viewer.one);
  click('reset', () => expose(first_exposure));
  click('worst', worst);
  click('copy', () => copy($('command').textContent, $('copy')));
  click('link', () => copy(location.href.split('#')[0] + '#' + hash(), $('link')));
  $('exposure').addEventListener('input', () => expose(Number($('exposure').value)));
  $('wipe').addEventListener('input', () => change({ wipe: $('wipe').value / 1000 }));
  $('marker').addEventListener('change', () => change({ marker: $('marker').checked }));
  $('area').addEventListener('change', () => change({ area: $('area').value }));
  $('metric').innerHTML = metrics_in(all_rows).map(m => `<option value="${m.key}">${m.name}</option>`).join('');
  $('viewing').hidden = views.length < 2;
  $('view').innerHTML = views.map((view, k) => `<option value="${k}">${escaped(view.camera || k + 1)}</option>`).join('');
  $('view').addEventListener('change', () => change({ view: Number($('view').value) }));
  $('metric').addEventListener('change', () => change({ metric: $('metric').value }));
  for (const button of document.querySelectorAll('[data-mode]'))
    button.addEventListener('click', () => change({ mode: button.dataset.mode }));
  // Lists and charts are drawn anew at each choice, so their boxes listen.
  for (const box of [$('methods'), $('plots')])
    box.addEventListener('click', event => {
      const hit = event.target.closest('[data-index]');
      if (hit) choose(Number(hit.dataset.index));
    });
  for (const box of document.querySelectorAll('#shares, #tables'))
    box.addEventListener('click', event => {
      const hit = event.target.closest('[data-method]');
      const entry = hit && entries.find(e => e.index && e.name === hit.dataset.method);
      if (entry) choose(entry.index, Number(hit.closest('[data-view]')?.dataset.view ?? state.view));
    });
}

const key_actions = {
  p: () => change({ mode: modes[0] }), s: () => change({ mode: modes[1] }), e: () => change({ mode: modes[2] }),
  '[': () => expose(state.exposure - 0.25), ']': () => expose(state.exposure + 0.25), r: () => expose(first_exposure),
  '+': () => viewer.zoom(2), '=': () => viewer.zoom(2), '-': () => viewer.zoom(1 / 2),
  f: viewer.fit, o: viewer.one, w: worst, m: () => change({ marker: !state.marker }),
  c: () => change({ view: (state.view + 1) % views.length }),
  ArrowRight: () => next(1), ArrowLeft: () => next(-1),
  ' ': () => choose(state.method ? 0 : last_method),
};

addEventListener('keydown', event => {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const own = event.target.closest?.('input[type=range], select, button, a, .dot, input[type=checkbox]');
  const dot = event.target.closest?.('.dot');
  if (dot && (event.key === 'Enter' || event.key === ' ')) {
    choose(Number(dot.dataset.index));
    return event.preventDefault();
  }
  // Controls in focus keep the keys that they take themselves.
  if (own && (event.key === ' ' || (event.key.startsWith('Arrow') && own.matches('input, select')))) return;
  const action = /^[0-9]$/.test(event.key) ? () => choose(Number(event.key)) : key_actions[event.key];
  if (!action) return;
  action();
  event.preventDefault();
});

wire();
state.exposure = first_exposure;
state.metric = metrics_in(all_rows)[0]?.key ?? '';
if (!all_rows.some(row => row.object)) state.area = 'frame', $('area').hidden = true;
// At the start what `first` names, else the method whose error is largest, because its worst region is the worst of all.
const largest = entries.reduce((a, b) => ((error_of(b)?.value ?? -1) > (error_of(a)?.value ?? -1) ? b : a));
state.method = entries.find(e => e.name === report.first)?.index ?? (largest.index || Math.min(1, entries.length - 1));
start(['reference', ...entries.slice(1).map(entry => entry.name)]);
listen(update);
update();
new ResizeObserver(() => drawn && draw_charts(entries, $('time'), $('bytes'))).observe($('plots'));
