// node mesh_csg.mjs SOLID.csg MESH.off [TRIANGLES]
//
// Makes a mesh of the solid that `tenon convert SCENE -o SOLID.csg` wrote, with about so many triangles: the error that
// primitives are meshed with is searched for. Without a number the mesh is as coarse as primitives get.
import { readFileSync, writeFileSync } from 'node:fs';
import { makeSolid, operations } from './solids.mjs';

// The nodes of the evaluated tree, { name, fields, children }: its text is names, arguments that are JSON but for the
// equals signs, and braces.
function parse(text) {
  let at = 0;
  const skip = () => { while (/\s/.test(text[at])) ++at; };
  const expect = (c) => { skip(); if (text[at++] !== c) throw new Error(`'${c}' is missing at ${at}`); };
  function node() {
    const name = /[\w$]+/y;
    name.lastIndex = at;
    const kind = name.exec(text)?.[0];
    if (!kind) throw new Error(`a name is missing at ${at}`);
    at += kind.length;
    expect('(');
    let depth = 1, begin = at;
    while (depth > 0) { const c = text[at++]; if (c === '(') ++depth; if (c === ')') --depth; }
    const inside = text.slice(begin, at - 1);
    const fields = inside.startsWith('[') ? { matrix: JSON.parse(inside) } :
        JSON.parse(`{${inside.replace(/(\w+) = /g, '"$1": ')}}`);
    skip();
    const children = [];
    if (text[at] === ';') ++at;
    else { expect('{'); for (skip(); text[at] !== '}'; skip()) children.push(node()); ++at; }
    return { kind, fields, children };
  }
  skip();
  return node();
}

// How much a matrix stretches: exact for turns and even scaling, of which the thesis's models are made.
const stretch = (m) => Math.hypot(...m.slice(0, 3).flatMap((row) => row.slice(0, 3))) / Math.sqrt(3);

// Of the parts nothing is kept: what WebAssembly holds is not given back by itself.
function combine(kind, parts, then) {
  const whole = parts.length === 1 ? parts[0] : operations[kind](parts);
  const result = then(whole);
  for (const solid of new Set([...parts, whole])) if (solid !== result) solid.delete();
  return result;
}

function build({ kind, fields, children }, error) {
  if (kind === 'multmatrix') {
    const solids = children.map((child) => build(child, error / stretch(fields.matrix)));
    const columns = [0, 1, 2, 3].flatMap((c) => fields.matrix.map((row) => row[c]));
    return combine('union', solids, (solid) => solid.transform(columns));
  }
  if (operations[kind]) return combine(kind, children.map((child) => build(child, error)), (solid) => solid);
  return makeSolid(kind, fields, error);
}

const [csg, off, triangles] = process.argv.slice(2);
const tree = parse(readFileSync(csg, 'utf8'));
// As coarse as primitives get, then ever finer until there are too many triangles; between the last two it is found.
let coarse = 1, fine = coarse, solid = build(tree, coarse);
const wanted = Number(triangles ?? 0);
function tryError(error) {
  const next = build(tree, error);
  const enough = next.numTri() > wanted;
  const nearer = Math.abs(next.numTri() - wanted) < Math.abs(solid.numTri() - wanted);
  (nearer ? solid : next).delete();
  if (nearer) solid = next;
  if (enough) fine = error; else coarse = error;
  return enough;
}
if (solid.numTri() < wanted) {
  for (let i = 0; i < 16 && !tryError(coarse / 2); ++i);
  for (let i = 0; i < 10; ++i) tryError(Math.sqrt(fine * coarse));
}
const { numVert, numTri, numProp, vertProperties: v, triVerts: t } = solid.getMesh();
const lines = [`OFF`, `${numVert} ${numTri} 0`];
for (let i = 0; i < numVert; ++i) lines.push(`${v[i * numProp]} ${v[i * numProp + 1]} ${v[i * numProp + 2]}`);
for (let i = 0; i < numTri; ++i) lines.push(`3 ${t[3 * i]} ${t[3 * i + 1]} ${t[3 * i + 2]}`);
writeFileSync(off, lines.join('\n') + '\n');
console.log(`${off}: ${numTri} triangles`);
