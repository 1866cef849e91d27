// Loads what `bake cubemap --for three` writes, without three.js filtering it once more. docs/environments.md shows it.
import * as THREE from 'three';
import { DDSLoader } from 'three/addons/loaders/DDSLoader.js';
import { read } from 'three/addons/libs/ktx-parse.module.js';

/// A cube texture whose levels are filtered already. CompressedCubeTexture is the one texture of three.js r187 whose levels its
/// shaders count rightly, whatever the format is.
function filtered(faces, format, type) {
  const texture = new THREE.CompressedCubeTexture(faces, format, type);
  texture.isPMREMTexture = true;
  texture.colorSpace = THREE.LinearSRGBColorSpace;
  texture.minFilter = THREE.LinearMipmapLinearFilter;
  texture.magFilter = THREE.LinearFilter;
  texture.generateMipmaps = false;
  texture.needsUpdate = true;
  return texture;
}

/// .dds with BC6H.
export async function load_dds(url) {
  const { image, format } = await new DDSLoader().loadAsync(url);
  return filtered(image, format, THREE.HalfFloatType);
}

/// .ktx2 with BC6H or half floats, which KTX2Loader does not load as a cube map.
export async function load_ktx2(url) {
  const { vkFormat, pixelWidth, levels } = read(new Uint8Array(await (await fetch(url)).arrayBuffer()));
  const halves = vkFormat === 97; // VK_FORMAT_R16G16B16A16_SFLOAT
  if (!halves && vkFormat !== 143) throw new Error(`${url}: write it with --texels bc6h or half`); // VK_FORMAT_BC6H_UFLOAT_BLOCK
  const faces = [0, 1, 2, 3, 4, 5].map(face => ({
    width: pixelWidth, height: pixelWidth,
    mipmaps: levels.map(({ levelData }, level) => {
      const bytes = levelData.slice(face * levelData.length / 6, (face + 1) * levelData.length / 6);
      return { data: halves ? new Uint16Array(bytes.buffer) : bytes, width: pixelWidth >> level, height: pixelWidth >> level };
    }),
  }));
  return halves ? filtered(faces, THREE.RGBAFormat, THREE.HalfFloatType)
                : filtered(faces, THREE.RGB_BPTC_UNSIGNED_Format, THREE.HalfFloatType);
}
