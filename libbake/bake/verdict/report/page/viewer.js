// The picture: one canvas for all methods, so that zoom and place are shared.
import { error_block, exposed, false_colours, size, values } from './pictures.js';
import { change, state } from './state.js';

const numbers_from = 44; // CSS pixels per pixel from which numbers fit in
const most_zoom = 256;

/** view: what to draw; show(now) tells it, and on_point(pixel or undefined) is told where the pointer is. */
export function make_viewer(frame, canvas, on_point) {
  const context = canvas.getContext('2d');
  let shown = {}; // {reference, chosen, names, region}
  let pending = 0;

  const area = () => ({ w: frame.clientWidth, h: frame.clientHeight });
  const fit_scale = () => Math.min(area().w / size.width, area().h / size.height);
  const scale = () => state.zoom || fit_scale();
  const centre = () => (state.zoom ? { x: state.x, y: state.y } : { x: size.width / 2, y: size.height / 2 });
  /** The place of the picture's upper left corner, and its scale. */
  function placed() {
    const s = scale(), c = centre(), a = area();
    return { s, x: a.w / 2 - c.x * s, y: a.h / 2 - c.y * s };
  }
  /** Where a point of the screen is on the picture. */
  function picture_point(client_x, client_y) {
    const r = frame.getBoundingClientRect(), p = placed();
    return { x: (client_x - r.left - p.x) / p.s, y: (client_y - r.top - p.y) / p.s };
  }
  function go(zoom, x, y) {
    change({
      zoom: Math.min(most_zoom, Math.max(zoom, Math.min(fit_scale() / 4, 1 / 16))),
      x: Math.min(size.width, Math.max(0, x)), y: Math.min(size.height, Math.max(0, y)),
    });
  }
  /** Zooms by a factor, so that a point of the picture stays where it is. */
  function zoom_at(factor, point) {
    const s = scale(), c = centre(), to = Math.min(most_zoom, s * factor);
    go(to, point.x + ((c.x - point.x) * s) / to, point.y + ((c.y - point.y) * s) / to);
  }

  function draw_image(image, from, to, block = 1) {
    const a = area(), p = placed(), ratio = devicePixelRatio;
    context.save();
    context.beginPath();
    context.rect(from, 0, to - from, a.h);
    context.clip();
    context.imageSmoothingEnabled = p.s * ratio < 1;
    context.imageSmoothingQuality = 'high';
    context.drawImage(image, p.x, p.y, image.width * block * p.s, image.height * block * p.s);
    context.restore();
  }

  function tag(text, x, align) {
    context.font = '600 12px system-ui, sans-serif';
    const w = context.measureText(text).width + 16, left = align > 0 ? x : x - w;
    context.fillStyle = '#000a';
    context.beginPath();
    context.roundRect(left, 10, w, 22, 6);
    context.fill();
    context.fillStyle = '#fff';
    context.textAlign = 'left', context.textBaseline = 'middle';
    context.fillText(text, left + 8, 21.5);
  }

  function draw_region({ x, y, width, height }) {
    const p = placed();
    const left = Math.round(p.x + x * p.s) - 2, top = Math.round(p.y + y * p.s) - 2;
    const box = [left, top, Math.round(p.x + (x + width) * p.s) + 2 - left, Math.round(p.y + (y + height) * p.s) + 2 - top];
    context.lineWidth = 4, context.strokeStyle = '#000b';
    context.strokeRect(...box);
    context.lineWidth = 2, context.strokeStyle = '#ffd84d';
    context.strokeRect(...box);
    if (box[1] < 36) return;
    context.font = '11px system-ui, sans-serif';
    context.textAlign = 'left', context.textBaseline = 'bottom';
    context.lineWidth = 3, context.strokeStyle = '#000b';
    context.strokeText('worst region', box[0], box[1] - 3);
    context.fillStyle = '#ffd84d';
    context.fillText('worst region', box[0], box[1] - 3);
  }

  /** Numbers in the pixels, of what each side of the wipe shows. */
  function draw_numbers(picture, from, to) {
    const p = placed(), a = area();
    const x0 = Math.max(0, Math.floor((from - p.x) / p.s)), x1 = Math.min(size.width, Math.ceil((to - p.x) / p.s));
    const y0 = Math.max(0, Math.floor(-p.y / p.s)), y1 = Math.min(size.height, Math.ceil((a.h - p.y) / p.s));
    if (x1 <= x0 || y1 <= y0) return;
    const { light, errors } = values(picture, x0, y0, x1 - x0, y1 - y0);
    context.save();
    context.beginPath();
    context.rect(from, 0, to - from, a.h);
    context.clip();
    const line = Math.min(15, p.s / 4);
    context.font = `${Math.min(13, p.s / 4.6)}px ui-monospace, 'DejaVu Sans Mono', monospace`;
    context.textAlign = 'center', context.textBaseline = 'middle';
    context.lineWidth = 3, context.lineJoin = 'round', context.strokeStyle = '#000c';
    for (let y = y0, i = 0; y < y1; ++y)
      for (let x = x0; x < x1; ++x, ++i) {
        const error_mode = state.mode === 'error' && errors;
        const texts = error_mode ? [errors[i].toFixed(3)] : light[i].map(v => (v < 100 ? v.toFixed(v < 10 ? 3 : 1) : v.toFixed(0)));
        texts.forEach((text, k) => {
          const at = [p.x + (x + 0.5) * p.s, p.y + (y + 0.5) * p.s + (k - (texts.length - 1) / 2) * line];
          context.fillStyle = error_mode ? '#fff' : ['#ff9d9d', '#a6f0a6', '#a9c8ff'][k];
          context.strokeText(text, ...at);
          context.fillText(text, ...at);
        });
      }
    context.restore();
  }

  function draw() {
    pending = 0;
    const a = area(), ratio = devicePixelRatio;
    const w = Math.round(a.w * ratio), h = Math.round(a.h * ratio);
    if (canvas.width !== w || canvas.height !== h) canvas.width = w, canvas.height = h;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, a.w, a.h);
    const { reference, chosen, names, region } = shown;
    if (!chosen) return;
    const wipe = state.mode === 'wipe' && reference && chosen !== reference ? Math.round(state.wipe * a.w) : 0;
    const colours = state.mode === 'error' && false_colours(chosen);
    if (wipe) draw_image(exposed(reference), 0, wipe);
    draw_image(colours || exposed(chosen), wipe, a.w, colours ? error_block(chosen) : 1);
    if (scale() >= numbers_from) {
      if (wipe) draw_numbers(reference, 0, wipe);
      draw_numbers(chosen, wipe, a.w);
    }
    if (region && state.marker) draw_region(region);
    if (wipe) {
      context.fillStyle = '#000b', context.fillRect(wipe - 2, 0, 4, a.h);
      context.fillStyle = '#fff', context.fillRect(wipe - 1, 0, 2, a.h);
      context.beginPath();
      context.arc(wipe, a.h / 2, 9, 0, 2 * Math.PI);
      context.fill();
      tag(names[0], wipe - 10, -1);
      tag(names[1], wipe + 10, 1);
    } else tag((colours ? 'FLIP of ' : '') + names[1], 10, 1);
    canvas.dataset.drawn = JSON.stringify(placed());
  }

  // Pointers: one pans or moves the wipe, two zoom.
  const pointers = new Map();
  let moves_wipe = false;
  frame.addEventListener('pointerdown', event => {
    if (event.button !== 0) return;
    frame.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    const x = event.clientX - frame.getBoundingClientRect().left;
    moves_wipe = state.mode === 'wipe' && Math.abs(x - state.wipe * area().w) < 14;
  });
  frame.addEventListener('pointermove', event => {
    const point = picture_point(event.clientX, event.clientY);
    const x = Math.floor(point.x), y = Math.floor(point.y);
    on_point(x >= 0 && y >= 0 && x < size.width && y < size.height ? { x, y } : undefined);
    const old = pointers.get(event.pointerId);
    if (!old) return;
    const others = [...pointers].filter(([id]) => id !== event.pointerId).map(([, p]) => p);
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (others.length) {
      const before = Math.hypot(old.x - others[0].x, old.y - others[0].y);
      const after = Math.hypot(event.clientX - others[0].x, event.clientY - others[0].y);
      const middle = picture_point((event.clientX + others[0].x) / 2, (event.clientY + others[0].y) / 2);
      if (before > 0) zoom_at(after / before, middle);
    } else if (moves_wipe) {
      const r = frame.getBoundingClientRect();
      change({ wipe: Math.min(1, Math.max(0, (event.clientX - r.left) / r.width)) });
    } else {
      const s = scale(), c = centre();
      go(s, c.x - (event.clientX - old.x) / s, c.y - (event.clientY - old.y) / s);
    }
  });
  for (const kind of ['pointerup', 'pointercancel'])
    frame.addEventListener(kind, event => pointers.delete(event.pointerId));
  frame.addEventListener('pointerleave', () => on_point(undefined));
  frame.addEventListener('wheel', event => {
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 16 : 1;
    zoom_at(Math.exp(-event.deltaY * lines * (event.ctrlKey ? 0.01 : 0.002)), picture_point(event.clientX, event.clientY));
  }, { passive: false });
  frame.addEventListener('dblclick', event => zoom_at(2, picture_point(event.clientX, event.clientY)));

  const redraw = () => (pending ||= requestAnimationFrame(draw));
  new ResizeObserver(redraw).observe(frame);
  return {
    /** Draws at once, so that what is on the screen is what was chosen. */
    show(now) {
      shown = now;
      draw();
    },
    redraw,
    scale,
    zoom: factor => zoom_at(factor, centre()),
    fit: () => change({ zoom: 0 }),
    one: () => go(1 / devicePixelRatio, centre().x, centre().y),
    /** Shows a rectangle of the picture with as much again around it. */
    jump({ x, y, width, height }) {
      const a = area();
      go(Math.min(a.w / width, a.h / height) / 3, x + width / 2, y + height / 2);
    },
  };
}
