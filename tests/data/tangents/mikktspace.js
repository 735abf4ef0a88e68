// Writes mikktspace.json: meshes, and the tangents that the npm package mikktspace 1.1.1 gives them. Not part of the build:
//   npm install mikktspace@1.1.1 && node mikktspace.js > mikktspace.json
const { generateTangents } = require('mikktspace');

let state = 1;
function random() { // Park and Miller
    state = (state * 48271) % 2147483647;
    return state / 2147483647;
}
const f = Math.fround;
const unit = v => v.map(x => x / Math.hypot(...v));

// A grid of columns x rows quads that closes round a tube or a ball, two triangles a quad.
function mesh(name, columns, rows, point, normal, uv, options = {}) {
    const m = { name, positions: [], triangles: [], normals: [], uvs: [] };
    for (let j = 0; j <= rows; ++j)
        for (let i = 0; i < columns; ++i) m.positions.push(point(i, j).map(f));
    const corner = (i, j, face) => {
        m.triangles.push(j * columns + i % columns);
        m.normals.push(unit(normal(i % columns, j, face)).map(f));
        m.uvs.push(uv(i, j, face).map(f));
    };
    for (let j = 0; j < rows; ++j)
        for (let i = 0; i < columns; ++i) {
            const face = j * columns + i;
            for (const [a, b] of [[0, 0], [1, 0], [1, 1]]) corner(i + a, j + b, face);
            for (const [a, b] of options.split ? [[0, 0], [1, 1], [0, 1]] : [[1, 1], [0, 1], [0, 0]]) corner(i + a, j + b, face);
        }
    return m;
}
const turn = 2 * Math.PI;
const tube = (i, j) => {
    const a = turn * i / 9, r = 1 + 0.3 * Math.sin(1.3 * j + i);
    return [r * Math.cos(a), 0.4 * j + 0.1 * Math.cos(3 * a), r * Math.sin(a)];
};
const tubeNormal = i => [Math.cos(turn * i / 9), 0.2, Math.sin(turn * i / 9)];
const ball = (i, j) => {
    const a = turn * i / 8, b = Math.PI * j / 6;
    return [Math.sin(b) * Math.cos(a), Math.cos(b), Math.sin(b) * Math.sin(a)].map(x => Math.round(x * 1e6) / 1e6);
};
const noise = [];
for (let k = 0; k < 400; ++k) noise.push([random(), random()]);

const meshes = [
    // One chart with a seam.
    mesh('seam', 9, 4, tube, tubeNormal, (i, j) => [i / 9, 1 - j / 4]),
    // Charts that are mirrored at the fourth column and at the seam, where texture coordinates are those of both sides.
    mesh('mirrored', 9, 4, tube, tubeNormal, (i, j) => [Math.abs(i - 4) / 9, 1 - j / 4 + 0.02 * i]),
    // A texture coordinate of its own for every face and corner, of both hands.
    mesh('torn', 9, 4, tube, tubeNormal, (i, j, face) => [i / 9 * (face % 3 ? 1 : -1) + 0.2 * noise[face][0],
                                                        j / 4 + 0.3 * noise[face][1]]),
    // Rough: hard normals every fourth face, texture coordinates that fold over within faces.
    mesh('rough', 9, 4, tube, (i, j, face) => face % 4 ? tubeNormal(i) : [noise[face][0], 1, noise[face][1]],
         (i, j) => noise[(i * 5 + j) % 45], { split: true }),
    // Collapsed triangles at the poles of a ball, and a row of faces without area in texture coordinates.
    mesh('poles', 8, 6, ball, (i, j) => j == 0 ? [0, 1, 0] : j == 6 ? [0, -1, 0] : ball(i, j),
         (i, j) => [i / 8, j == 3 ? 2 / 6 : j / 6]),
];
for (const m of meshes) {
    const tangents = generateTangents(new Float32Array(m.triangles.flatMap(v => m.positions[v])),
                                      new Float32Array(m.normals.flat()), new Float32Array(m.uvs.flat()));
    m.tangents = m.triangles.map((_, k) => Array.from(tangents.slice(4 * k, 4 * k + 4)));
}
const round = (key, value) => typeof value === 'number' ? Number(value.toPrecision(9)) : value;
console.log('[\n' + meshes.map(m => '{' + Object.entries(m).map(([k, v]) => JSON.stringify(k) + ': ' + JSON.stringify(v, round))
    .join(',\n') + '}').join(',\n') + '\n]');
