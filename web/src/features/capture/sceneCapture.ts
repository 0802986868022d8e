// The capture area on the floor of the 3-D scene.

import { Group, Mesh } from 'three';
import type { CreateSceneObject } from '../../scene/sceneLayer';
import { type Point, triangles } from '../../scene/solids';
import { Strokes } from '../../scene/strokes';
import { sectorsOf } from './sectors';

const UP_M = 8e-4;

export const sceneCapture: CreateSceneObject = (paints, scene) => {
  const sectors = sectorsOf(scene);
  const style = { width_px: 1.5, through: true, isCased: true };
  const edge = new Strokes(paints, 'magnet', 2 * sectors.length, style);
  for (const [from, to] of sectors.flatMap(({ inner, outer }) => [inner, outer])) {
    edge.move(...from, UP_M).line(...to, UP_M);
  }
  const corners = sectors.flatMap(({ inner: [a, b], outer: [c, d] }) => [a, c, d, a, d, b]);
  const fill = triangles(corners.map(([x, y]): Point => [x, y, UP_M]));
  const object = new Group().add(
    new Mesh(fill, paints.flat('field-high', { clipped: true, opacity: 0.16 })),
    edge.done().object,
  );
  return {
    object,
    place: ({ tool_m: [x, y] }) => object.position.set(x, y, 0),
  };
};
