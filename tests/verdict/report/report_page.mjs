// Uses every control of a report in a headless Chromium: report_page.mjs FOLDER, which has report.html of
// little_report.h, plan.html of hand_made_plan.h, bare.html, a report of nothing, and job.json with what the pictures show.
import { createRequire } from 'node:module';
import { readFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const { chromium } = createRequire(join(process.env.NODE_PATH, 'of_this_folder.js'))('playwright-core');
const folder = resolve(process.argv[2]);
const { methods, exposure, red } = JSON.parse(readFileSync(join(folder, 'job.json'), 'utf8'));
const address = name => pathToFileURL(join(folder, name)).href;
const report = address('report.html');
const worst = { x: 8, y: 8, width: 16, height: 16 };
const inside = { x: 12, y: 12 }, bright = { x: 48, y: 12 }, plain = { x: 80, y: 50 };

const faults = [];
let checks = 0;
function check(good, what) {
  ++checks;
  if (!good) faults.push(what);
}
function near(found, wanted, reach, what) {
  const far = [found].flat().some((v, i) => !(Math.abs(v - [wanted].flat()[i]) <= reach));
  check(!far, `${what}: ${found} instead of ${wanted}`);
}

const encode = v => 255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055);
const decode = l => (l / 255 <= 0.04045 ? l / 255 / 12.92 : ((l / 255 + 0.055) / 1.055) ** 2.4);
const brighter = (level, stops) => encode(Math.min(1, decode(level) * 2 ** stops));

const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ['--no-sandbox'] });
const requests = [];
/** All pictures are decoded, so that a choice is drawn at once. */
const ready = page => page.waitForFunction(() => document.documentElement.dataset.loaded);
async function open(where, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, ...options });
  await context.grantPermissions(['clipboard-read', 'clipboard-write']);
  await context.setOffline(true);
  const page = await context.newPage();
  page.setDefaultTimeout(10_000);
  page.on('request', request => requests.push(request.url()));
  page.on('pageerror', fault => faults.push(String(fault)));
  page.on('console', line => ['error', 'warning'].includes(line.type()) && faults.push(line.text()));
  await page.goto(where);
  if (options.javaScriptEnabled !== false && !where.includes('bare.html'))
    await ready(page);
  return page;
}

/** What the page tells of its view. */
const view_of = page => page.evaluate(() => {
  const canvas = document.getElementById('canvas'), box = canvas.getBoundingClientRect();
  return { ...JSON.parse(canvas.dataset.drawn), left: box.left, top: box.top, w: box.width, h: box.height };
});
/** Turns the wheel and waits for what comes of it, because the browser answers before it has happened. */
async function wheel(page, amount) {
  const before = (await view_of(page)).s;
  await page.mouse.wheel(0, amount);
  await page.waitForFunction(s => JSON.parse(document.getElementById('canvas').dataset.drawn).s !== s, before);
}
/** Where the middle of a pixel is on the page. */
async function place(page, { x, y }) {
  const v = await view_of(page);
  return [v.left + v.x + (x + 0.5) * v.s, v.top + v.y + (y + 0.5) * v.s];
}
/** The colours on the screen in a rectangle of the page, without alpha. */
const colours_at = (page, x, y, w, h) => page.evaluate(([px, py, width, height]) => {
  const canvas = document.getElementById('canvas'), box = canvas.getBoundingClientRect();
  const copy = document.createElement('canvas');
  copy.width = width, copy.height = height;
  const context = copy.getContext('2d', { willReadFrequently: true });
  context.drawImage(canvas, -Math.floor((px - box.left) * devicePixelRatio), -Math.floor((py - box.top) * devicePixelRatio));
  const data = context.getImageData(0, 0, width, height).data;
  return Array.from({ length: width * height }, (_, i) => [...data.slice(4 * i, 4 * i + 3)]);
}, [x, y, w, h]);
const colour_at = async (page, [x, y]) => (await colours_at(page, x, y, 1, 1))[0];
const colour = async (page, pixel) => colour_at(page, await place(page, pixel));
const pressed = (page, what) => page.locator(`${what}[aria-pressed=true]`).evaluateAll(all => all.map(b => b.dataset.index ?? b.dataset.mode ?? b.id).join());
const shows = async (page, index, what) => {
  near(await colour(page, inside), [red[index], 128, 60], 1, `${what}: the square of method ${index}`);
  check(await pressed(page, '#methods button') === String(index), `${what}: method ${index} is pressed in the list`);
};

async function check_methods(page) {
  await shows(page, 2, 'at the start, the method of the largest error');
  for (let i = 0; i <= 9; ++i) {
    await page.keyboard.press(String(i));
    await shows(page, i, `key ${i}`);
  }
  await page.keyboard.press('ArrowRight');
  await shows(page, 10, 'arrow right');
  await page.keyboard.press('ArrowRight');
  await shows(page, 0, 'arrow right, from the last');
  await page.keyboard.press('ArrowLeft');
  await shows(page, 10, 'arrow left');
  await page.keyboard.press(' ');
  await shows(page, 0, 'space');
  await page.keyboard.press(' ');
  await shows(page, 10, 'space again');
  await page.click('#methods [data-index="4"]');
  await shows(page, 4, 'a click in the list');
  check(await page.textContent('#name') === methods[4], 'a name is shown as it is');
  await page.click('#tables tr[data-method="exact"]');
  await shows(page, 5, 'a click in the table');
  await page.click('#shares li[data-method="bump"] div');
  await shows(page, 6, 'a click on a bar');
}

async function check_dots(page) {
  for (const [chart, index] of [['time', 3], ['bytes', 7]]) {
    await page.click(`#${chart} .dot[data-index="${index}"] .number`);
    await shows(page, index, `a dot of ${chart}`);
    check(await page.textContent('#command') === `bake compare s.toml --methods '${methods[index]}'`, `the command of dot ${index}`);
  }
  await page.focus('#time .dot[data-index="1"]');
  await page.keyboard.press('Enter');
  await shows(page, 1, 'Enter on a dot');
  check(await page.locator('#time .dot').count() === 9, 'a dot for each method with a time');
  check(await page.locator('#time .dot.best').count() >= 1, 'a Pareto front');
  const label = () => page.getAttribute('#time .dot[data-index="1"]', 'aria-label');
  check((await label()).includes('FLIP, mean 0.02'), 'a dot tells its error');
  await page.selectOption('#metric', 'normals');
  check((await label()).includes('angle of normals, degrees 12.5'), 'the error can be chosen');
  check((await page.textContent('#methods [data-index="1"] .value')) === '12.5', 'the list shows the error that is chosen');
  await page.selectOption('#metric', 'rmse');
  await page.selectOption('#area', 'frame');
  check((await label()).includes('RMSE'), 'the frame can be chosen');
  await page.selectOption('#area', 'object');
  await page.selectOption('#metric', 'flip');
  await page.click('#copy');
  check(await page.evaluate(() => navigator.clipboard.readText()) === `bake compare s.toml --methods 'plain'`, 'the copied command');
}

async function check_wipe(page) {
  await page.keyboard.press('5');
  await page.click('[data-mode=wipe]');
  check(await page.isVisible('#wiping'), 'the slider of the wipe is seen');
  // The square is left of the middle of the frame.
  await shows_side(page, 500, 0);
  await shows_side(page, 0, 5);
  await page.focus('#wipe');
  await page.keyboard.press('End');
  near(await colour(page, inside), [red[0], 128, 60], 1, 'End moves the wipe to the right');
  await page.locator('#wipe').fill('700');
  const v = await view_of(page);
  await page.mouse.move(v.left + 0.7 * v.w, v.top + v.h / 2);
  await page.mouse.down();
  await page.mouse.move(v.left + 0.1 * v.w, v.top + v.h / 2, { steps: 3 });
  await page.mouse.up();
  near(Number(await page.inputValue('#wipe')), 100, 2, 'the handle drags the wipe');
  near(await colour(page, inside), [red[5], 128, 60], 1, 'the dragged wipe');
  await page.locator('#wipe').fill('500');
  await page.keyboard.press('p');
  check(await page.isHidden('#wiping'), 'p leaves the wipe');
  await page.keyboard.press('s');
  check(await pressed(page, '[data-mode]') === 'wipe', 's wipes');
  await page.click('[data-mode=picture]');
}
async function shows_side(page, wipe, index) {
  await page.locator('#wipe').fill(String(wipe));
  near(await colour(page, inside), [red[index], 128, 60], 1, `wipe at ${wipe}: method ${index}`);
}

async function check_zoom(page) {
  await page.keyboard.press('f');
  const whole = await view_of(page);
  near(whole.s, Math.min(whole.w / 96, whole.h / 64), 1e-6, 'the whole picture fits');
  const at = await place(page, { x: 30, y: 20 });
  await page.mouse.move(...at);
  await wheel(page, -400);
  const closer = await view_of(page);
  near(closer.s / whole.s, Math.exp(0.8), 0.01, 'the wheel zooms');
  near(await place(page, { x: 30, y: 20 }), at, 1.3, 'the point below the wheel stays');
  await page.mouse.down();
  await page.mouse.move(at[0] + 37, at[1] - 21, { steps: 4 });
  await page.mouse.up();
  near(await place(page, { x: 30, y: 20 }), [at[0] + 37, at[1] - 21], 1.3, 'dragging pans');
  await page.keyboard.press('5');
  near((await view_of(page)).s, closer.s, 1e-9, 'methods share the zoom');
  await page.mouse.dblclick(...at);
  near((await view_of(page)).s, closer.s * 2, 1e-6, 'a double click zooms');
  await page.click('#out');
  near((await view_of(page)).s, closer.s, 1e-6, 'the button zooms out');
  await page.click('#in');
  await page.keyboard.press('-');
  await page.keyboard.press('+');
  near((await view_of(page)).s, closer.s * 2, 1e-6, 'buttons and keys zoom');
  await page.click('#one');
  near((await view_of(page)).s, 1, 1e-6, '1:1');
  check((await page.textContent('#scale')).trim() === '100 %', 'the scale is told');
  await page.click('#fit');
  near((await view_of(page)).s, whole.s, 1e-6, 'the button fits');
  await page.keyboard.press('o');
  near((await view_of(page)).s, 1, 1e-6, 'o is 1:1');
  await page.evaluate(() => {
    const frame = document.getElementById('frame'), box = frame.getBoundingClientRect();
    frame.setPointerCapture = () => {}; // of pointers that are not there
    const send = (kind, id, x) => frame.dispatchEvent(new PointerEvent(kind,
      { pointerId: id, clientX: box.left + x, clientY: box.top + 100, button: 0, bubbles: true }));
    send('pointerdown', 11, 200), send('pointerdown', 12, 300);
    send('pointermove', 12, 500);
    send('pointerup', 11, 200), send('pointerup', 12, 500);
    delete frame.setPointerCapture;
  });
  near((await view_of(page)).s, 3, 1e-6, 'two fingers zoom');
}

async function check_numbers(page) {
  await page.keyboard.press('f');
  await page.keyboard.press('3');
  await page.mouse.move(...await place(page, inside));
  const text = await page.textContent('#values');
  check(text.includes('pixel 12, 12'), `the pixel is named: ${text}`);
  const light = l => Number((decode(l) / 2 ** exposure).toPrecision(3));
  for (const value of [light(red[0]), light(red[3]), light(128), light(60), '0.502']) check(text.includes(value), `${value} in: ${text}`);
  await page.mouse.move(...await place(page, bright));
  near(Number((await page.locator('#values tr').nth(1).locator('td').first().textContent())), 4, 0.05, 'radiance above white');
  check(/off by|exact to/.test(await page.textContent('#exact')), 'how exact the numbers are');
  // In a pixel of 100 x 100 on the screen there are numbers: another colour than its own.
  await page.goto(report + '#m=exact&z=100&x=80.5&y=50.5&marker=0');
  await page.reload();
  await ready(page);
  near((await view_of(page)).s, 100, 1e-6, 'the zoom of the address');
  const [x, y] = await place(page, plain);
  const colours = new Set((await colours_at(page, x - 45, y - 45, 90, 90)).map(String)).size;
  check(colours > 10, `numbers in a large pixel: ${colours} colours`);
}

async function check_exposure(page) {
  await page.goto(report + '#m=bump');
  await page.reload();
  await ready(page);
  const level = red[6];
  await page.locator('#exposure').fill(String(exposure + 1));
  near(await colour(page, inside), [level, 128, 60].map(l => brighter(l, 1)), 1.01, 'a stop more');
  check(await page.textContent('#stops') === '+2', 'the exposure is told');
  await page.keyboard.press('[');
  near(await colour(page, inside), [level, 128, 60].map(l => brighter(l, 0.75)), 1.01, 'the key [');
  await page.locator('#exposure').fill(String(exposure - 3.5));
  // 4 at the exposure of the reference is 8; 3.5 stops below that it is 0.71.
  near(await colour(page, bright), Array(3).fill(encode(8 / 2 ** 3.5)), 3, 'highlights come out when it is darker');
  await page.click('#reset');
  near(await colour(page, inside), [level, 128, 60], 1, 'reset');
  await page.keyboard.press(']');
  await page.keyboard.press('r');
  near(await colour(page, inside), [level, 128, 60], 1, 'the keys ] and r');
}

async function check_error(page) {
  await page.click('[data-mode=error]');
  // Magma at 128 / 255 of its 17 knots.
  near(await colour(page, inside), [183, 55, 122], 2, 'the colour of an error of 0.5');
  near(await colour(page, plain), [0, 0, 4], 1, 'the colour of no error');
  check(await page.isVisible('#legend'), 'the legend of errors');
  await page.keyboard.press('p');
  check(await page.isHidden('#legend'), 'no legend beside a picture');
  await page.keyboard.press('e');
  check(await pressed(page, '[data-mode]') === 'error', 'e shows errors');
  await page.keyboard.press('p');
}

async function check_worst(page) {
  await page.keyboard.press('f');
  const yellow = async () => {
    const [x, y] = await place(page, { x: 16, y: 8 }), v = await view_of(page);
    const c = await colour_at(page, [x, y - v.s / 2 - 2]);
    return c[0] > 200 && c[1] > 160 && c[2] < 130;
  };
  check(await yellow(), 'a marker around the worst region');
  await page.uncheck('#marker');
  check(!(await yellow()), 'no marker');
  await page.keyboard.press('m');
  check(await yellow(), 'm brings it back');
  for (const jump of [() => page.click('#worst'), () => page.keyboard.press('w')]) {
    await page.keyboard.press('f');
    await jump();
    const v = await view_of(page);
    near([(v.w / 2 - v.x) / v.s, (v.h / 2 - v.y) / v.s], [worst.x + 8, worst.y + 8], 0.01, 'the worst region is in the middle');
    near(v.s, v.h / 48, 0.01, 'and fills a third');
  }
  check((await page.textContent('#place')).includes('16 × 16 pixels at 8, 8'), 'the region in words');
}

async function check_links(page) {
  await page.keyboard.press('8');
  await page.keyboard.press('s');
  await page.locator('#wipe').fill('250');
  await page.locator('#exposure').fill(String(exposure + 0.5));
  await page.uncheck('#marker');
  await page.selectOption('#metric', 'outline');
  await page.mouse.move(...await place(page, { x: 20, y: 20 }));
  await wheel(page, -150);
  const before = await view_of(page);
  await page.waitForFunction(() => location.hash.includes('outline') && location.hash.includes('wipe=0.25'));
  await page.click('#link');
  const link = await page.evaluate(() => navigator.clipboard.readText());
  check(link === page.url(), `the copied link: ${link}`);
  const other = await open(link);
  const after = await view_of(other);
  near([after.x, after.y, after.s], [before.x, before.y, before.s], 0.5, 'the place of the link');
  check(await pressed(other, '#methods button') === '8', 'the method of the link');
  check(await pressed(other, '[data-mode]') === 'wipe', 'the mode of the link');
  check(await other.inputValue('#wipe') === '250', 'the wipe of the link');
  check(Number(await other.inputValue('#exposure')) === exposure + 0.5, 'the exposure of the link');
  check(!(await other.isChecked('#marker')), 'the marker of the link');
  check(await other.inputValue('#metric') === 'outline', 'the error of the link');
  await other.evaluate(() => (location.hash = '#m=reference'));
  await shows(other, 0, 'a changed address');
  await other.goto(report + '#m=nobody&z=x&e=1e9&mode=toString&wipe=7');
  await other.reload();
  await shows(other, 2, 'a damaged address is that of the start');
  await other.context().close();
}

async function check_paper(page) {
  await page.emulateMedia({ media: 'print' });
  check(await page.isHidden('#stage'), 'no viewer on paper');
  for (const part of ['#tables table >> nth=0', '#time svg', '#bytes svg', '#shares li >> nth=0', '#commands li >> nth=0', '#pictures'])
    check(await page.isVisible(part), `${part} on paper`);
  const loaded = await page.locator('#pictures img:not(.highlights)').evaluateAll(all => all.map(i => i.naturalWidth > 0 && i.getClientRects().length > 0));
  check(loaded.length === 21 && loaded.every(Boolean), 'all pictures on paper');
  check((await page.pdf({ format: 'A4' })).length > 20_000, 'a PDF');
  await page.emulateMedia({ media: 'screen' });
  check(await page.isHidden('#pictures'), 'pictures apart only on paper');
}

async function check_without_script() {
  const page = await open(report, { javaScriptEnabled: false });
  check(await page.isHidden('#viewer'), 'no viewer without a script');
  check(await page.isHidden('#charts'), 'no empty charts without a script');
  check(await page.locator('#tables tbody tr:visible').count() === 20, 'tables without a script');
  check(await page.locator('#pictures img:visible').count() === 21, 'pictures without a script');
  check(await page.locator('#commands code:visible').count() === 11, 'commands without a script');
  check(await page.locator('#shares li:visible').count() === 10, 'bars without a script');
  await page.context().close();
}

/** Two cameras of three grey pictures each; see add_pictures() of hand_made_plan.h. */
async function check_plan() {
  const page = await open(address('plan.html'));
  const left = { x: 5, y: 16 }, right = { x: 40, y: 16 };
  const grey = async (pixel, light, what) => near(await colour(page, pixel), Array(3).fill(encode(light)), 1, `plan: ${what}`);
  check(await page.isVisible('#decisions tbody tr >> nth=0'), 'plan: the first decision');
  await page.keyboard.press('m');
  await grey(left, 0.2, 'at the start, what is planned');
  await page.keyboard.press('0');
  await grey(left, 0.1, 'key 0 is the reference');
  await page.keyboard.press(' ');
  await grey(left, 0.2, 'space, and back');
  await grey(right, 0.1, 'the half that is equal');
  await page.keyboard.press('2');
  await grey(right, 0.3, 'key 2 is everything bumped');
  await page.keyboard.press('c');
  await grey(right, 0.6, 'key c is the next camera');
  check(await page.inputValue('#view') === '1', 'plan: the list of cameras');
  await page.selectOption('#view', '0');
  await grey(right, 0.3, 'the list of cameras chooses');
  await page.click('[data-view="1"] tr[data-method="planned"]');
  await grey(left, 0.5, 'a row shows the picture of its camera');
  await page.waitForFunction(() => location.hash.includes('v=1'));
  const other = await open(page.url());
  check(await other.inputValue('#view') === '1', 'plan: the camera of a link');
  await other.context().close();
  await page.keyboard.press('e');
  near(await colour(page, right), [0, 0, 4], 1, 'plan: no error where the pictures are equal');
  check(await page.isHidden('#charts'), 'plan: no charts of methods');
  await page.context().close();
  const still = await open(address('plan.html'), { javaScriptEnabled: false });
  check(await still.isVisible('#decisions tbody tr >> nth=0'), 'plan: decisions without a script');
  check(await still.locator('#decisions dt:visible').count() === 4, 'plan: reasons without a script');
  check(await still.isVisible('#rungs svg'), 'plan: a chart without a script');
  check(await still.locator('#pictures img:visible').count() === 10, 'plan: pictures without a script');
  await still.context().close();
}

try {
  const page = await open(report);
  const first = await page.evaluate(() => performance.getEntriesByName('first-picture')[0].startTime);
  await check_methods(page);
  await check_dots(page);
  await check_wipe(page);
  await check_zoom(page);
  await check_numbers(page);
  await check_exposure(page);
  await check_error(page);
  await check_worst(page);
  await check_links(page);
  await check_paper(page);
  await check_without_script();
  await check_plan();
  const bare = await open(address('bare.html'));
  check((await bare.textContent('h1')) === 'scene', 'a report of nothing');
  for (const key of ['1', 'w', 'e', 's', '+', ']', ' ', 'ArrowLeft']) await bare.keyboard.press(key);
  const foreign = requests.filter(url => !url.startsWith('file:') && !url.startsWith('data:'));
  const files = requests.filter(url => url.startsWith('file:') && !/\/(report|plan|bare)\.html(#|$)/.test(url));
  check(!foreign.length && !files.length, `requests: ${[...foreign, ...files].slice(0, 3)}`);
  console.log(`${checks} checks; first picture after ${first.toFixed(0)} ms`);
} catch (fault) {
  faults.push(String(fault));
} finally {
  await browser.close();
}
for (const fault of faults) console.error(`report_page: ${fault.split('\n').slice(0, 3).join(' ')}`);
process.exit(faults.length ? 1 : 0);
