// node make_mesh.mjs SOLID.json MESH.bin
//
// Makes the triangle mesh of a solid with Manifold. SOLID.json holds the CSG tree as mesh.cpp writes it; each leaf says
// how far its mesh may lie from its surface, in its local frame. MESH.bin holds two 32-bit counts, then three floats a
// vertex, then three 32-bit indices a triangle, little-endian. What it took is printed as JSON; reading the tree and
// starting WebAssembly are not counted.
import { readFileSync, writeFileSync } from 'node:fs';
import { makeSolid, operations } from './solids.mjs';

const { nodes, root } = JSON.parse(readFileSync(process.argv[2], 'utf8'));
const began = { wall: performance.now(), cpu: process.cpuUsage() };
const solids = [];
for (const node of nodes) {
  if (node.kind) solids.push(makeSolid(node.kind, node.fields, node.error).transform(node.matrix));
  else if (operations[node.operation]) solids.push(operations[node.operation](node.children.map((i) => solids[i])));
  else throw new Error(`a ${node.operation} cannot be meshed; leave it out of this scene`);
}
const mesh = solids[root].getMesh();
const cpu = process.cpuUsage(began.cpu);
const seconds = (performance.now() - began.wall) / 1000;

if (mesh.numProp !== 3) throw new Error('the mesh has more than positions');
const counts = new Uint32Array([mesh.numVert, mesh.numTri]);
writeFileSync(process.argv[3], Buffer.concat([counts, mesh.vertProperties, mesh.triVerts].map(
    (a) => Buffer.from(a.buffer, a.byteOffset, a.byteLength))));
console.log(JSON.stringify({ triangles: mesh.numTri, seconds, cpu_seconds: (cpu.user + cpu.system) / 1e6 }));
