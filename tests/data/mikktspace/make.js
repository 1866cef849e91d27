// Writes the reference tangents beside this file: npm install mikktspace@1.1.1, then node make.js
const { generateTangents } = require('mikktspace');
const { writeFileSync } = require('fs');

let state = 1;
const random = (low, high) => {
  state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
  return low + ((high - low) * (state >>> 8)) / 2 ** 24;
};
const unit = v => v.map(x => x / Math.hypot(...v));

// Each corner is [position, normal, uv]; three corners are a triangle.
const fan = quad => [quad[0], quad[1], quad[2], quad[0], quad[2], quad[3]];

function write(name, corners) {
  const flat = k => new Float32Array(corners.flatMap(corner => corner[k]));
  const [position, normal, uv] = [flat(0), flat(1), flat(2)];
  const tangent = generateTangents(position, normal, uv);
  const out = new Float32Array(12 * corners.length);
  for (let c = 0; c < corners.length; ++c) {
    out.set(position.subarray(3 * c, 3 * c + 3), 12 * c);
    out.set(normal.subarray(3 * c, 3 * c + 3), 12 * c + 3);
    out.set(uv.subarray(2 * c, 2 * c + 2), 12 * c + 6);
    out.set(tangent.subarray(4 * c, 4 * c + 4), 12 * c + 8);
  }
  writeFileSync(`${__dirname}/${name}.f32`, out);
}

// A bumpy sheet whose last quarter is mirrored in u. Some vertices share one uv, so that triangles between them have no
// area in uv; some vertices share one position, so that triangles between them have no area.
function sheet(n) {
  const grid = [];
  for (let j = 0; j <= n; ++j)
    for (let i = 0; i <= n; ++i) {
      const turned = i < (n * 3) / 4 ? i : (n * 3) / 2 - i;
      const place = random(0, 1) < 0.03 ? [3, 3, 0] : [i + random(-0.3, 0.3), j + random(-0.3, 0.3), random(-0.3, 0.3)];
      const uv = random(0, 1) < 0.05 ? [0.5, 0.5] : [turned + random(-0.3, 0.3), j + random(-0.3, 0.3)];
      grid.push([place, unit([random(-0.3, 0.3), random(-0.3, 0.3), 1]), uv]);
    }
  const corners = [];
  for (let j = 0; j < n; ++j)
    for (let i = 0; i < n; ++i) {
      const at = j * (n + 1) + i;
      corners.push(...fan([grid[at], grid[at + 1], grid[at + n + 2], grid[at + n + 1]]));
    }
  return corners;
}

// A torus with a seam in uv all round both ways; every third column has the normals of its faces.
function torus(columns, rows) {
  const corner = (i, j, flat) => {
    const at = (x, y) => [(2 * Math.PI * x) / columns, (2 * Math.PI * y) / rows];
    const [u, v] = at(i % columns, j % rows);
    const [nu, nv] = flat ?? [u, v];
    const radius = 1 + 0.4 * Math.cos(v);
    return [[radius * Math.cos(u), radius * Math.sin(u), 0.4 * Math.sin(v)],
            [Math.cos(nu) * Math.cos(nv), Math.sin(nu) * Math.cos(nv), Math.sin(nv)], [i / columns, j / rows]];
  };
  const corners = [];
  for (let j = 0; j < rows; ++j)
    for (let i = 0; i < columns; ++i) {
      const middle = [(2 * Math.PI * (i + 0.5)) / columns, (2 * Math.PI * (j + 0.5)) / rows];
      const flat = i % 3 === 0 ? middle : undefined;
      corners.push(...fan([corner(i, j, flat), corner(i + 1, j, flat), corner(i + 1, j + 1, flat), corner(i, j + 1, flat)]));
    }
  return corners;
}

// Random triangles between few vertices: edges of many faces, faces in both orientations, faces twice, a vertex twice.
function tangle(vertices, triangles) {
  const whole = (low, high) => Math.floor(random(low, high));
  const pool = [];
  for (let k = 0; k < vertices; ++k)
    pool.push([[whole(0, 4), whole(0, 4), whole(0, 4)], unit([random(-1, 1), random(-1, 1), 1.5]), [whole(0, 5), whole(0, 5)]]);
  return Array.from({ length: 3 * triangles }, () => pool[whole(0, vertices)]);
}

write('sheet', sheet(20));
write('torus', torus(24, 12));
write('tangle', tangle(40, 300));
