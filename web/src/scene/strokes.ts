// 3-D lines with a width in pixels. WebGL's own lines are always one pixel wide.

import { InstancedInterleavedBuffer, InterleavedBufferAttribute, Object3D } from 'three';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';
import type { PaintName, Paints, Stroke } from './paints';

/** Two ends with three coordinates each. */
const NUMBERS = 6;

/** A drawing of at most `capacity` segments that is overwritten in place. */
export class Strokes {
  readonly object = new Object3D();
  private readonly geometry = new LineSegmentsGeometry();
  private readonly ends: Float32Array;
  private readonly buffer: InstancedInterleavedBuffer;
  private count = 0;
  private readonly pen: [number, number, number] = [0, 0, 0];

  constructor(
    paints: Paints,
    name: PaintName,
    private readonly capacity: number,
    stroke: Stroke,
  ) {
    this.ends = new Float32Array(NUMBERS * capacity);
    this.buffer = new InstancedInterleavedBuffer(this.ends, NUMBERS, 1);
    const { geometry } = this;
    geometry.setAttribute('instanceStart', new InterleavedBufferAttribute(this.buffer, 3, 0));
    geometry.setAttribute('instanceEnd', new InterleavedBufferAttribute(this.buffer, 3, 3));
    geometry.instanceCount = 0;
    const materials = [
      ...(stroke.isCased ? [paints.casing(stroke)] : []),
      paints.stroke(name, stroke),
    ];
    materials.forEach((material, i) => {
      const lines = new LineSegments2(geometry, material);
      // Otherwise every change would need new bounds.
      lines.frustumCulled = false;
      // All casings lie below all lines.
      lines.renderOrder = i === materials.length - 1 && name !== 'case' ? 1 : 0;
      this.object.add(lines);
    });
  }

  clear(): this {
    this.count = 0;
    return this;
  }

  /** Starts a line here. */
  move(x: number, y: number, z: number): this {
    this.pen[0] = x;
    this.pen[1] = y;
    this.pen[2] = z;
    return this;
  }

  /** Continues the line to a place. */
  line(x: number, y: number, z: number): this {
    if (this.count < this.capacity) {
      const at = NUMBERS * this.count;
      this.ends.set(this.pen, at);
      this.ends[at + 3] = x;
      this.ends[at + 4] = y;
      this.ends[at + 5] = z;
      this.count += 1;
    }
    return this.move(x, y, z);
  }

  circle(x: number, y: number, z: number, radius: number, corners = 64): this {
    this.move(x + radius, y, z);
    for (let i = 1; i <= corners; i++) {
      const angle = (2 * Math.PI * i) / corners;
      this.line(x + radius * Math.cos(angle), y + radius * Math.sin(angle), z);
    }
    return this;
  }

  cross(x: number, y: number, z: number, half: number): this {
    this.move(x - half, y, z).line(x + half, y, z);
    return this.move(x, y - half, z).line(x, y + half, z);
  }

  /** Shows what was drawn since `clear`. */
  done(): this {
    this.buffer.needsUpdate = true;
    this.geometry.instanceCount = this.count;
    this.object.visible = this.count > 0;
    return this;
  }
}
