// Runs scripts/three_viewer_page.mjs in a headless Chromium and writes the pictures that it makes.
//
//   three_viewer JOB.json       files in a job are relative to its folder
//
//   {"model": "model.glb",            or .gltf, .usda
//    "sky": ["px.png", "nx.png", "py.png", "ny.png", "pz.png", "nz.png"],   8-bit sRGB or .exr; or absent;
//                                  or one .dds or .ktx2 of bake cubemap --for three, which is not filtered again;
//                                  or one lat-long, .hdr or .exr
//    "camera": {"position": [0, 1, 5], "target": [0, 0, 0], "up": [0, 1, 0], "fov_deg": 40},   vertical field of view
//    "size": [512, 512],
//    "outputs": [
//      {"what": "normals", "file": "n.f32"},         world-space shading normals
//      {"what": "radiance", "file": "r.f32", "samples": 4, "background": true},   samples^2 per pixel; with the sky behind
//      {"what": "radiance", "file": "r.png", "exposure": -1,   in stops, sRGB-encoded
//       "model": "other.glb", "camera": {...}},   instead of those of the job
//      {"what": "lobe", "roughness": 0.5, "file": "l.f32",    a sphere of radius 1 at the origin: the filtered sky as it is
//       "directions": true},       looked up; or the directions, in the world
//      {"what": "texture", "texture": "n.ktx2", "level": 0, "file": "t.f32"}]}   texels of a level of this "size"
//
// "nodes": true beside "model" draws with the WebGPURenderer and its WebGL2 backend; outputs are normals alone then:
//       {"what": "normals", "file": "n.f32", "material": "asset.mtlx"}   instead of the model's own
// "tangents": true in an output: the meshes get tangents of MikkTSpace.
//
// .f32: R, G, B, A as 32-bit floats, low byte first, rows from the top down; A is the share of samples on the model, or 1
// with a background. No tone mapping, no shadows, no lights but the sky.
import { createRequire } from 'node:module';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, extname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const packages = process.env.NODE_PATH;
const { chromium } = createRequire(join(packages, 'of_this_folder.js'))('playwright-core');
const job_file = resolve(process.argv[2] ?? '');
let job;
try {
  job = JSON.parse(readFileSync(job_file, 'utf8'));
} catch (fault) {
  console.error(`three_viewer: ${job_file}: ${fault.message}`);
  process.exit(2);
}

// The page reads all its files through this function: there is no server and no network.
const origin = 'http://viewer.invalid';
const roots = {
  '/scripts/': dirname(fileURLToPath(import.meta.url)),
  '/three/': join(packages, 'three'),
  '/job/': dirname(job_file),
};
const types = { '.mjs': 'text/javascript', '.js': 'text/javascript', '.png': 'image/png', '.jpg': 'image/jpeg' };
const builds = job.nodes
  ? { 'three': '/three/build/three.webgpu.js', 'three/webgpu': '/three/build/three.webgpu.js', 'three/tsl': '/three/build/three.tsl.js' }
  : { 'three': '/three/build/three.module.js' };
const shell = `<!doctype html><script type="importmap">
  ${JSON.stringify({ imports: { ...builds, 'three/addons/': '/three/examples/jsm/' } })}</script>
  <script type="module" src="/scripts/${job.nodes ? 'three_nodes_page' : 'three_viewer_page'}.mjs"></script>`;

async function answer(route) {
  const path = decodeURIComponent(new URL(route.request().url()).pathname);
  if (path === '/') return route.fulfill({ contentType: 'text/html', body: shell });
  const root = Object.keys(roots).find(name => path.startsWith(name));
  const file = root && join(roots[root], path.slice(root.length));
  if (!file || !existsSync(file)) return route.fulfill({ status: 404, body: '' });
  return route.fulfill({ contentType: types[extname(file)] ?? 'application/octet-stream', body: readFileSync(file) });
}

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  // SwiftShader computes in software, so that no graphics card changes the figures.
  args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
});
let code = 0;
try {
  const page = await browser.newPage();
  page.setDefaultTimeout(60_000);
  const complaints = [];
  page.on('pageerror', fault => complaints.push(String(fault)));
  // A busy machine makes the driver tell of its own slowness.
  const complains = line => ['error', 'warning'].includes(line.type()) && !/GL Driver Message \(OpenGL, Performance/.test(line.text());
  page.on('console', line => complains(line) && complaints.push(line.text()));
  await page.route('**/*', answer);
  await page.goto(origin + '/');
  try {
    await page.waitForFunction(() => window.show);
    for (const output of job.outputs) {
      const bytes = Buffer.from(await page.evaluate(([j, o]) => window.show(j, o), [job, output]), 'base64');
      writeFileSync(resolve(dirname(job_file), output.file), bytes);
    }
  } catch (fault) {
    code = 1;
    complaints.push(String(fault));
  }
  for (const text of complaints) console.error(`three_viewer: ${text.split('\n')[0]}`);
} finally {
  await browser.close();
}
process.exit(code);
