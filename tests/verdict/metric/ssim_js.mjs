// SSIM by the npm package ssim.js: node ssim_js.mjs FOLDER WIDTH HEIGHT PAIRS prints a line for each pair of files FOLDER/a0, b0,
// a1, b1 ... of grey levels of 8 bits.
import { createRequire } from 'node:module';
import { readFileSync } from 'node:fs';

const { ssim } = createRequire(process.env.NODE_PATH + '/')('ssim.js');
const [folder, width, height, pairs] = [process.argv[2], ...process.argv.slice(3).map(Number)];
const picture = (name) => {
  const grey = readFileSync(`${folder}/${name}`);
  const data = new Uint8ClampedArray(4 * grey.length);
  grey.forEach((level, i) => data.set([level, level, level, 255], 4 * i));
  return { data, width, height };
};
for (let i = 0; i < pairs; ++i)
  console.log(ssim(picture(`a${i}`), picture(`b${i}`), { ssim: 'original', downsample: false }).mssim);
