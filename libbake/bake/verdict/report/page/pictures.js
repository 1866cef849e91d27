// The stored pictures: decoded by the browser, exposed and coloured here, and read pixel by pixel.
import { state } from './state.js';

const decode_srgb = v => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);
const encode_srgb = v => (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055);
const light_of_level = Float64Array.from({ length: 256 }, (_, i) => decode_srgb(i / 255));

let first_exposure = 0, highlight_stops = 8;
export const size = { width: 0, height: 0 };

function canvas_of(width, height) {
  const canvas = document.createElement('canvas');
  canvas.width = width, canvas.height = height;
  return canvas;
}
// Canvases that are read stay in the processor's memory.
const context_of = canvas => canvas.getContext('2d', { willReadFrequently: true });

/** Colours of the errors 0 to 255, from the filter that colours the pictures of the printed page. */
const magma = (() => {
  const tables = ['R', 'G', 'B'].map(c =>
    document.querySelector(`#magma feFunc${c}`).getAttribute('tableValues').split(' ').map(Number));
  const colours = new Uint8ClampedArray(256 * 3);
  for (let i = 0; i < 256; ++i) {
    const at = (i / 255) * 16, k = Math.min(15, Math.floor(at));
    tables.forEach((t, c) => (colours[3 * i + c] = 255 * (t[k] + (at - k) * (t[k + 1] - t[k]))));
  }
  return colours;
})();

export function draw_ramp(canvas) {
  const context = canvas.getContext('2d'), image = context.createImageData(256, 1);
  for (let i = 0; i < 256; ++i) image.data.set([...magma.subarray(3 * i, 3 * i + 3), 255], 4 * i);
  context.putImageData(image, 0, 0);
}

/** The pictures of the page in its order, of each view the reference first. */
export function find_pictures(data) {
  first_exposure = Number(data.report.exposure) || 0;
  highlight_stops = data.highlight_stops;
  const pictures = [...document.querySelectorAll('#pictures figure')].map(figure => ({
    method: figure.dataset.method,
    view: Number(figure.dataset.view),
    images: Object.fromEntries(['shown', 'highlights', 'errors'].map(kind => [kind, figure.querySelector('img.' + kind)])),
    canvases: {},
    loading: {},
  }));
  return pictures;
}

/** Decodes "shown", with its highlights, or "errors" of a picture once. */
export function load(picture, what) {
  return (picture.loading[what] ??= Promise.all((what === 'shown' ? ['shown', 'highlights'] : [what]).map(async kind => {
    const image = picture.images[kind];
    if (!image) return;
    image.loading = 'eager'; // lazy until here, so that the first picture does not wait for the others
    await image.decode();
    const canvas = canvas_of(image.naturalWidth, image.naturalHeight);
    context_of(canvas).drawImage(image, 0, 0);
    picture.canvases[kind] = canvas;
    if (kind === 'shown') size.width = canvas.width, size.height = canvas.height;
  })).then(() => picture.loading[what] = true));
}
export const is_loaded = (picture, what) => picture.loading[what] === true;

const pixels = (canvas, x = 0, y = 0, w = canvas.width, h = canvas.height) =>
  context_of(canvas).getImageData(x, y, w, h);

/** A new canvas with each pixel passed through colour(levels, highlight levels, index of the pixel, to). */
function coloured(picture, kind, colour) {
  const from = pixels(picture.canvases[kind]), bright = picture.canvases.highlights;
  const high = kind === 'shown' && bright ? pixels(bright).data : null;
  const data = from.data;
  for (let i = 0; i < data.length; i += 4) colour(data, high, i);
  const canvas = canvas_of(from.width, from.height);
  context_of(canvas).putImageData(from, 0, 0);
  return canvas;
}

const kept = new Map(); // the last exposed pictures

/** The picture as the exposure of the state shows it. */
export function exposed(picture) {
  if (state.exposure === first_exposure) return picture.canvases.shown;
  const key = picture.method + ' ' + state.exposure + ' ' + picture.canvases.shown.width;
  for (const [name, value] of kept) if (name === key && value.picture === picture) return value.canvas;
  const factor = 2 ** (state.exposure - first_exposure);
  const level = light => 255 * encode_srgb(Math.min(1, light * factor));
  const low = Uint8ClampedArray.from(light_of_level, level);
  const top = Uint8ClampedArray.from({ length: 256 }, (_, i) => level(2 ** ((i / 255) * highlight_stops)));
  const canvas = coloured(picture, 'shown', (data, high, i) => {
    for (let c = i; c < i + 3; ++c) data[c] = high && high[c] ? top[high[c]] : low[data[c]];
  });
  kept.set(key, { picture, canvas });
  if (kept.size > 6) kept.delete(kept.keys().next().value);
  return canvas;
}

/** How many pixels of the picture, along each side, one of the stored errors covers: 2 if the page had to be small. */
export const error_block = picture => (picture.canvases.errors.width < size.width ? 2 : 1);

/** The errors in false colours; undefined if there are none. */
export function false_colours(picture) {
  if (!picture.canvases.errors) return undefined;
  return (picture.canvases.colours ??= coloured(picture, 'errors', (data, _, i) => {
    data.set(magma.subarray(3 * data[i], 3 * data[i] + 3), i);
  }));
}

/** Radiance and errors of a rectangle: {light: [r, g, b] per pixel, errors: one per pixel or undefined}. */
export function values(picture, x, y, w, h) {
  const levels = pixels(picture.canvases.shown, x, y, w, h).data;
  const high = picture.canvases.highlights && pixels(picture.canvases.highlights, x, y, w, h).data;
  const scale = 2 ** -first_exposure, light = [];
  for (let i = 0; i < levels.length; i += 4)
    light.push([0, 1, 2].map(c =>
      scale * (high && high[i + c] ? 2 ** ((high[i + c] / 255) * highlight_stops) : light_of_level[levels[i + c]])));
  return { light, errors: picture.canvases.errors && errors_of(picture, x, y, w, h) };
}

function errors_of(picture, x, y, w, h) {
  const canvas = picture.canvases.errors, block = error_block(picture), x0 = Math.floor(x / block), y0 = Math.floor(y / block);
  const columns = Math.ceil((x + w) / block) - x0, rows = Math.ceil((y + h) / block) - y0;
  const levels = pixels(canvas, x0, y0, columns, rows).data, errors = [];
  for (let j = 0; j < h; ++j)
    for (let i = 0; i < w; ++i)
      errors.push(levels[4 * ((Math.floor((y + j) / block) - y0) * columns + Math.floor((x + i) / block) - x0)] / 255);
  return errors;
}
