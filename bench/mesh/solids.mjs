// Meshes of single primitives by Manifold, each within a given distance of its surface.
import Module from 'manifold-3d';

const wasm = await Module();
wasm.setup();
const { Manifold, CrossSection } = wasm;

// Segments of a circle whose chords stay within `error` of it: r (1 - cos(pi / n)) <= error.
const circleSegments = (r, error) => Math.max(3, Math.ceil(Math.PI / Math.acos(Math.max(0, 1 - error / r))));

// How far the faces of Manifold's unit sphere, a subdivided octahedron, lie inside of it.
const sphereErrors = new Map();
function sphereError(segments) {
  if (!sphereErrors.has(segments)) {
    const { vertProperties: v, triVerts: t } = Manifold.sphere(1, segments).getMesh();
    let least = 1;
    for (let i = 0; i < t.length; i += 3) {
      const [a, b, c] = [0, 1, 2].map((k) => v.subarray(3 * t[i + k], 3 * t[i + k] + 3));
      const e = [b[0] - a[0], b[1] - a[1], b[2] - a[2]], f = [c[0] - a[0], c[1] - a[1], c[2] - a[2]];
      const n = [e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]];
      least = Math.min(least, (n[0] * a[0] + n[1] * a[1] + n[2] * a[2]) / Math.hypot(...n));
    }
    sphereErrors.set(segments, 1 - least);
  }
  return sphereErrors.get(segments);
}
function sphere({ r }, error) {
  let segments = 4 * Math.max(1, Math.floor(circleSegments(r, error) / 4));
  while (sphereError(segments) > error / r) segments += 4;
  return Manifold.sphere(r, segments);
}

// A profile of revolution in (radius, z), closed over the axis. The chords of the profile and those of the circles take
// half of the error each.
function revolved(height, radiusAt, steps, segments) {
  const curve = Array.from({ length: steps + 1 }, (_, i) => height(i / steps)).map((z) => [radiusAt(z), z]);
  const profile = [[0, curve[0][1]], ...curve, [0, curve[steps][1]]];
  return Manifold.revolve([profile.filter((p, i) => i === 0 || p[0] !== profile[i - 1][0] || p[1] !== profile[i - 1][1])],
                          segments);
}
function hyperboloid({ h, r, waist }, error) {
  const slope = (r * r - waist * waist) / (h * h / 4);
  // The radius bends most at the waist, by slope / waist; a chord over dz is off by an eighth of that times dz^2.
  const steps = Math.max(2, Math.ceil(h * Math.sqrt(slope / waist / (4 * error))));
  return revolved((s) => h * (s - 0.5), (z) => Math.sqrt(waist * waist + slope * z * z), steps, circleSegments(r, error / 2));
}
function paraboloid({ h, r }, error) {
  // z = h s^2 at radius r s: a chord over ds is off by h ds^2 / 4 along z, and by less across.
  const steps = Math.max(2, Math.ceil(Math.sqrt(h / (2 * error))));
  return revolved((s) => h * s * s, (z) => r * Math.sqrt(z / h), steps, circleSegments(r, error / 2));
}
function torus({ R, r }, error) {
  const tube = CrossSection.circle(r, circleSegments(r, error / 2)).translate([R, 0]);
  return tube.revolve(circleSegments(R + r, error / 2));
}

const makers = {
  sphere,
  cube: ({ size, center }) => Manifold.cube(size, center),
  cylinder: ({ h, r, center }, error) => Manifold.cylinder(h, r, r, circleSegments(r, error), center),
  cone: ({ h, r1, r2, center }, error) => Manifold.cylinder(h, r1, r2, circleSegments(Math.max(r1, r2), error), center),
  torus,
  hyperboloid,
  paraboloid,
};

// A primitive of these fields, its mesh within `error` of its surface.
export function makeSolid(kind, fields, error) {
  if (!makers[kind]) throw new Error(`a ${kind} cannot be meshed; leave it out of this scene`);
  return makers[kind](fields, error);
}

export const operations = { union: Manifold.union, intersection: Manifold.intersection, difference: Manifold.difference };
