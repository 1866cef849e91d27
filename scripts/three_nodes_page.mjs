// The page of scripts/three_viewer for jobs with "nodes": materials of nodes, MaterialX among them, which three.js draws with
// its WebGPURenderer alone; without WebGPU by its WebGL2 backend.
import * as THREE from 'three';
import { normalWorld, vec4 } from 'three/tsl';
import { MaterialXLoader } from 'three/addons/loaders/MaterialXLoader.js';
import { camera_of, load_model, url } from './three_model.mjs';

const renderer = new THREE.WebGPURenderer({ forceWebGL: true });
renderer.toneMapping = THREE.NoToneMapping;
renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
await renderer.init();

/// RGBA floats, rows from the top down.
async function render(scene, camera, [width, height]) {
  const target = new THREE.RenderTarget(width, height, { type: THREE.FloatType });
  renderer.setRenderTarget(target);
  renderer.setClearColor(0x000000, 0);
  renderer.render(scene, camera);
  const read = await renderer.readRenderTargetPixelsAsync(target, 0, 0, width, height);
  renderer.setRenderTarget(null);
  target.dispose();
  const out = new Float32Array(width * height * 4);
  const row = width * 4;
  for (let y = 0; y < height; ++y) out.set(read.subarray((height - 1 - y) * row, (height - y) * row), y * row);
  return out;
}

/// Gives all meshes the first material of the document. MaterialXLoader wants tangents, and looks up pictures as GLTFLoader
/// does, with v down, whatever its `uvSpace` is: the uvs of USD would show them upside down.
async function dress(model, file) {
  const { materials, warnings } = await new MaterialXLoader().loadAsync(url(file));
  for (const warning of warnings) console.warn(warning.message);
  const material = Object.values(materials)[0];
  model.traverse(object => { if (object.isMesh) object.material = material; });
}

window.show = async (job, output) => {
  const model = await load_model(output.model ?? job.model, output.tangents);
  if (output.material) await dress(model, output.material);
  const scene = new THREE.Scene();
  scene.add(model);
  scene.updateMatrixWorld(true);
  model.traverse(object => [object.material ?? []].flat().forEach(material => {
    material.outputNode = vec4(normalWorld, 1);
    material.blending = THREE.NoBlending;
  }));
  const values = await render(scene, camera_of(output.camera ?? job.camera, job.size, scene), job.size);
  const bytes = new Uint8Array(values.buffer);
  let text = '';
  for (let i = 0; i < bytes.length; i += 0x8000) text += String.fromCharCode(...bytes.subarray(i, i + 0x8000));
  return btoa(text);
};
