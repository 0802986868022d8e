// The capture area on the floor of the 3-D scene.

import { Group, Mesh } from 'three';
import type { CreateSceneObject } from '../../scene/sceneLayer';
import { type Point, triangles } from '../../scene/solids';
import { Strokes } from '../../scene/strokes';
import { BEYOND_M } from './drawCapture';

const UP_M = 8e-4;

/** A ring of sectors around the tool, because a turned block pulls differently in each direction. */
export const sceneCapture: CreateSceneObject = (paints, { capture_m }) => {
  const sector = (2 * Math.PI) / capture_m.length;
  const at = (k: number, distance_m: number): Point => [
    distance_m * Math.cos(k * sector),
    distance_m * Math.sin(k * sector),
    UP_M,
  ];
  const fill: Point[] = [];
  const edge = new Strokes(paints, 'tool', 2 * capture_m.length, {
    width_px: 1.25,
    opacity: 0.8,
    through: true,
    clipped: true,
  });
  capture_m.forEach((reach, k) => {
    const next = capture_m[(k + 1) % capture_m.length];
    if (!reach || !next) return;
    const [innerA, innerB] = [at(k, reach[0]), at(k + 1, next[0])];
    const [outerA, outerB] = [at(k, reach[1] ?? BEYOND_M), at(k + 1, next[1] ?? BEYOND_M)];
    fill.push(innerA, outerA, outerB, innerA, outerB, innerB);
    edge.move(...outerA).line(...outerB);
    edge.move(...innerA).line(...innerB);
  });
  edge.done();
  const object = new Group().add(
    new Mesh(triangles(fill), paints.flat('tool', { opacity: 0.08, through: true, clipped: true })),
    edge.object,
  );
  return {
    object,
    place: ({ tool_m: [x, y] }) => {
      object.position.set(x, y, 0);
    },
  };
};
