// node make_bunny.mjs BUNNY.off
//
// Writes the Stanford bunny as the npm package `bunny` has it (closed, in the public domain), z up and standing on z = 0.
import { writeFileSync } from 'node:fs';
import bunny from 'bunny';

const lowest = Math.min(...bunny.positions.map(([, y]) => y));
const points = bunny.positions.map(([x, y, z]) => [x, -z, y - lowest]);
writeFileSync(
  process.argv[2],
  `OFF\n${points.length} ${bunny.cells.length} 0\n` +
    points.map((p) => p.join(' ') + '\n').join('') +
    bunny.cells.map((cell) => `3 ${cell.join(' ')}\n`).join('')
);
