// The page of scripts/three_viewer: loads a model and a sky of six faces as any application of three.js would, and
// reads back floats.
import * as THREE from 'three';
import { KTX2Loader } from 'three/addons/loaders/KTX2Loader.js';
import { EXRLoader } from 'three/addons/loaders/EXRLoader.js';
import { HDRLoader } from 'three/addons/loaders/HDRLoader.js';
import { load_dds, load_ktx2 } from './three_environment.mjs';
import { camera_of, load_model, url } from './three_model.mjs';

const renderer = new THREE.WebGLRenderer();
renderer.toneMapping = THREE.NoToneMapping;
if (!renderer.extensions.has('EXT_color_buffer_float')) throw new Error('this browser does not render to floats');

/// EXRLoader gives the lowest row first; a face of a cube map has its upper row first.
function upside_down({ image, type }) {
  const { data, width, height } = image;
  const row = data.length / height;
  const turned = new data.constructor(data.length);
  for (let y = 0; y < height; ++y) turned.set(data.subarray(y * row, (y + 1) * row), (height - 1 - y) * row);
  return new THREE.DataTexture(turned, width, height, THREE.RGBAFormat, type);
}

async function load_latlong(file) {
  const picture = await (file.endsWith('.hdr') ? new HDRLoader() : new EXRLoader()).loadAsync(url(file));
  picture.mapping = THREE.EquirectangularReflectionMapping;
  return picture;
}

async function load_sky(files) {
  if (!files) return null;
  if (files.length === 1) {
    const load = { dds: load_dds, ktx2: load_ktx2 }[files[0].split('.').pop()];
    return load ? load(url(files[0])) : load_latlong(files[0]);
  }
  if (!files[0].endsWith('.exr')) return new THREE.CubeTextureLoader().loadAsync(files.map(url));
  const faces = await Promise.all(files.map(file => new EXRLoader().loadAsync(url(file))));
  const cube = new THREE.CubeTexture(faces.map(upside_down));
  cube.type = faces[0].type;
  cube.colorSpace = THREE.LinearSRGBColorSpace;
  cube.minFilter = cube.magFilter = THREE.LinearFilter;
  cube.generateMipmaps = false;
  cube.needsUpdate = true;
  return cube;
}

/// The normal with which the material is shaded, in world space, instead of radiance.
function show_normals(material) {
  material.onBeforeCompile = shader => {
    shader.fragmentShader = shader.fragmentShader.replace('#include <opaque_fragment>',
      'gl_FragColor = vec4( normalize( ( vec4( normal, 0.0 ) * viewMatrix ).xyz ), 1.0 );');
  };
  material.customProgramCacheKey = () => 'normals';
  material.blending = THREE.NoBlending;
}

/// RGBA floats of samples x samples per pixel, averaged; rows from the top down.
function render(scene, camera, [width, height], samples) {
  const wide = width * samples, high = height * samples;
  const target = new THREE.WebGLRenderTarget(wide, high, { type: THREE.FloatType });
  renderer.setRenderTarget(target);
  renderer.setClearColor(0x000000, 0);
  renderer.clear();
  renderer.render(scene, camera);
  const fine = new Float32Array(wide * high * 4);
  renderer.readRenderTargetPixels(target, 0, 0, wide, high, fine);
  renderer.setRenderTarget(null);
  target.dispose();
  const out = new Float32Array(width * height * 4);
  for (let y = 0; y < high; ++y)
    for (let x = 0; x < wide; ++x) {
      const from = ((high - 1 - y) * wide + x) * 4; // OpenGL's rows begin at the bottom
      const to = (Math.floor(y / samples) * width + Math.floor(x / samples)) * 4;
      for (let c = 0; c < 4; ++c) out[to + c] += fine[from + c] / (samples * samples);
    }
  return out;
}

async function png(values, [width, height], exposure) {
  const srgb = v => v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055;
  const levels = new Uint8ClampedArray(values.length);
  for (let i = 0; i < values.length; ++i)
    levels[i] = i % 4 === 3 ? 255 : Math.round(255 * srgb(Math.min(Math.max(values[i] * 2 ** exposure, 0), 1)));
  const canvas = new OffscreenCanvas(width, height);
  canvas.getContext('2d').putImageData(new ImageData(levels, width, height), 0, 0);
  return new Uint8Array(await (await canvas.convertToBlob({ type: 'image/png' })).arrayBuffer());
}

function base64(bytes) {
  let text = '';
  for (let i = 0; i < bytes.length; i += 0x8000) text += String.fromCharCode(...bytes.subarray(i, i + 0x8000));
  return btoa(text);
}

/// A level of a texture, texel by texel, as a shader reads it.
async function texels(file, level, size) {
  const map = await new KTX2Loader().detectSupport(renderer).loadAsync(url(file));
  const material = new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3,
    uniforms: { map: { value: map } },
    vertexShader: 'in vec3 position; void main() { gl_Position = vec4(position, 1.0); }',
    fragmentShader: `precision highp float; precision highp sampler2D; uniform sampler2D map; out vec4 colour;
      void main() { // the first row is the upper one
        colour = texelFetch(map, ivec2(int(gl_FragCoord.x), ${size[1] - 1} - int(gl_FragCoord.y)), ${level});
      }`,
  });
  const scene = new THREE.Scene();
  scene.add(new THREE.Mesh(new THREE.PlaneGeometry(2, 2), material));
  return render(scene, new THREE.Camera(), size, 1);
}

/// What a white mirror of a roughness shows of the sky, with three.js' own look-up; or the directions in which it is looked up.
function show_lobe(roughness, directions) {
  const material = new THREE.MeshStandardMaterial({ metalness: 1 });
  const value = directions
    ? `normalize( mix( reflect( - geometryViewDir, geometryNormal ), geometryNormal, pow4( ${roughness.toFixed(6)} ) ) )`
    : `getIBLRadiance( geometryViewDir, geometryNormal, ${roughness.toFixed(6)} )`;
  material.onBeforeCompile = shader => {
    shader.fragmentShader = shader.fragmentShader.replace('#include <opaque_fragment>', directions
      ? `gl_FragColor = vec4( transformDirectionByInverseViewMatrix( ${value}, viewMatrix ), 1.0 );`
      : `gl_FragColor = vec4( ${value}, 1.0 );`);
  };
  material.customProgramCacheKey = () => `lobe ${roughness} ${directions}`;
  material.blending = THREE.NoBlending;
  const scene = new THREE.Scene();
  scene.add(new THREE.Mesh(new THREE.SphereGeometry(1, 256, 128), material));
  return scene;
}

let sky = null; // one sky serves all outputs of a job

/// One output of the job, its file as base64.
window.show = async (job, output) => {
  if (output.what === 'texture')
    return base64(new Uint8Array((await texels(output.texture, output.level ?? 0, job.size)).buffer));
  if (output.what === 'lobe') {
    const scene = show_lobe(output.roughness, output.directions ?? false);
    scene.environment = sky ??= await load_sky(job.sky);
    return base64(new Uint8Array(render(scene, camera_of(output.camera ?? job.camera, job.size, scene), job.size, 1).buffer));
  }
  const normals = output.what === 'normals';
  sky ??= normals ? null : await load_sky(job.sky); // its filtering takes seconds
  const scene = new THREE.Scene();
  scene.add(await load_model(output.model ?? job.model, output.tangents));
  scene.environment = sky;
  if (output.background) scene.background = sky;
  scene.updateMatrixWorld(true);
  if (normals) scene.traverse(object => [object.material ?? []].flat().forEach(show_normals));
  const values = render(scene, camera_of(output.camera ?? job.camera, job.size, scene), job.size, output.samples ?? 1);
  const bytes = output.file.endsWith('.png') ? await png(values, job.size, output.exposure ?? 0) : new Uint8Array(values.buffer);
  return base64(bytes);
};
