// What the pages of scripts/three_viewer share: models and cameras.
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { USDLoader } from 'three/addons/loaders/USDLoader.js';
import { computeMikkTSpaceTangents } from 'three/addons/utils/BufferGeometryUtils.js';
import * as MikkTSpace from 'three/addons/libs/mikktspace.module.js';

export const url = file => '/job/' + file.split('/').map(encodeURIComponent).join('/');

/// A .glb, .gltf or .usda. `tangents`: the meshes get those of MikkTSpace, which USDLoader does not give them.
export async function load_model(file, tangents = false) {
  const usd = file.endsWith('.usda');
  const model = usd ? await new USDLoader().loadAsync(url(file)) : (await new GLTFLoader().loadAsync(url(file))).scene;
  if (tangents) await MikkTSpace.ready;
  // The v of glTF points down, that of USD up.
  model.traverse(object => tangents && object.isMesh && computeMikkTSpaceTangents(object.geometry, MikkTSpace, !usd));
  return model;
}

export function camera_of({ position, target, up = [0, 1, 0], fov_deg = 40 }, [width, height], scene) {
  const box = new THREE.Box3().setFromObject(scene);
  const ball = box.getBoundingSphere(new THREE.Sphere());
  const away = ball.center.distanceTo(new THREE.Vector3(...position));
  const near = Math.max(away - ball.radius, ball.radius / 1000);
  const camera = new THREE.PerspectiveCamera(fov_deg, width / height, near * 0.99, (away + ball.radius) * 1.01);
  camera.position.set(...position);
  camera.up.set(...up);
  camera.lookAt(...target);
  return camera;
}
