// The camera's field of view in the 3-D scene.

import { Group, Mesh } from 'three';
import { ORDER } from '../../scene/paints';
import type { CreateSceneObject } from '../../scene/sceneLayer';
import { type Point, triangles } from '../../scene/solids';
import { Strokes } from '../../scene/strokes';

const UP_M = 8e-4;
/** Length of a bracket, as a share of its side. */
const BRACKET = 0.16;

/** Brackets around the visible area of the table, and lines from the camera to it. */
export const sceneFrustum: CreateSceneObject = (paints, { parameters, camera_sees_m }) => {
  const eye: Point = [
    parameters.camera_offset_x_m,
    parameters.camera_offset_y_m,
    parameters.camera_height_m,
  ];
  const corners = camera_sees_m.map(([x, y]): Point => [x, y, UP_M]);
  const sides = corners.flatMap((corner, k): Point[] => [
    eye,
    corner,
    corners[(k + 1) % corners.length] ?? corner,
  ]);
  const rays = new Strokes(paints, 'magnet', corners.length, { width_px: 1, opacity: 0.3 });
  const style = { width_px: 2, through: true, isCased: true };
  const foot = new Strokes(paints, 'magnet', 2 * corners.length, style);
  corners.forEach((corner, k) => {
    rays.move(...eye).line(...corner);
    const [x, y, z] = corner;
    for (const side of [1, corners.length - 1]) {
      const [toX, toY] = corners[(k + side) % corners.length] ?? corner;
      foot.move(x, y, z).line(x + BRACKET * (toX - x), y + BRACKET * (toY - y), z);
    }
  });
  rays.done();
  foot.done();
  // The lines are sorted by depth with the solids; the area on the floor is a mark.
  const air = new Group();
  air.renderOrder = ORDER.air;
  air.add(new Mesh(triangles(sides), paints.flat('magnet', { opacity: 0.03 })), rays.object);
  const object = new Group().add(air, foot.object);
  return {
    object,
    place: ({ tool_m: [x, y] }) => object.position.set(x, y, 0),
  };
};
