// What the page shows, and its permalink. All parts read `state` and change it through change().

/** view: which camera; zoom: CSS pixels per pixel of the picture, 0: the whole picture; x, y: the pixel in the middle; exposure in stops. */
export const state = {
  view: 0, method: 0, mode: 'picture', exposure: 0, zoom: 0, x: 0, y: 0, wipe: 0.5, marker: true, metric: '', area: 'object',
};
export const modes = ['picture', 'wipe', 'error'];

let listeners = [];
let names = [];
let defaults = {};

/** Calls `listener` after every change. */
export function listen(listener) {
  listeners.push(listener);
}

export function change(values) {
  Object.assign(state, values);
  for (const listener of listeners) listener();
}

const round = (value, digits) => String(Number(value.toFixed(digits)));

/** Key of the hash -> its text from the state, and the state from its text; undefined where the text is none. */
const keys = {
  m: { write: () => names[state.method], read: text => at('method', names.indexOf(text), i => i >= 0) },
  v: { write: () => String(state.view), read: text => at('view', Number(text), k => Number.isInteger(k) && k >= 0 && k < 1e6) },
  mode: { write: () => state.mode, read: text => at('mode', text, t => modes.includes(t)) },
  e: { write: () => round(state.exposure, 3), read: text => number('exposure', text, -30, 30) },
  z: { write: () => (state.zoom ? round(state.zoom, 4) : '0'), read: text => number('zoom', text, 0, 256) },
  x: { write: () => round(state.x, 2), read: text => number('x', text, -1e6, 1e6) },
  y: { write: () => round(state.y, 2), read: text => number('y', text, -1e6, 1e6) },
  wipe: { write: () => round(state.wipe, 3), read: text => number('wipe', text, 0, 1) },
  marker: { write: () => (state.marker ? '1' : '0'), read: text => at('marker', text === '1', () => true) },
  metric: { write: () => state.metric, read: text => at('metric', text, t => /^\w+$/.test(t)) },
  area: { write: () => state.area, read: text => at('area', text, t => t === 'object' || t === 'frame') },
};
function at(name, value, good) {
  return good(value) ? { [name]: value } : undefined;
}
function number(name, text, least, most) {
  const value = parseFloat(text);
  return at(name, value, v => v >= least && v <= most);
}

/** The hash of this view: what differs from the view at the start. */
export function hash() {
  const parts = new URLSearchParams();
  for (const [key, { write }] of Object.entries(keys)) if (write() !== defaults[key]) parts.set(key, write());
  return parts.toString();
}

function read_hash() {
  const parts = new URLSearchParams(location.hash.slice(1));
  const values = { ...defaults.state };
  for (const [key, { read }] of Object.entries(keys))
    if (parts.has(key)) Object.assign(values, read(parts.get(key)));
  return values;
}

/** Takes the present state as that of the start, then what the address says. `method_names` are those of the hash. */
export function start(method_names) {
  names = method_names;
  defaults = { state: { ...state } };
  for (const [key, { write }] of Object.entries(keys)) defaults[key] = write();
  Object.assign(state, read_hash());
  let timer = 0;
  const write = () => history.replaceState(null, '', '#' + hash());
  // Browsers allow about 100 changes in 30 seconds.
  listen(() => {
    clearTimeout(timer);
    timer = setTimeout(write, 150);
  });
  addEventListener('hashchange', () => {
    if (location.hash.slice(1) !== hash()) change(read_hash());
  });
}
