// Links of the arm that cover the bead or the goal become transparent. Pure except for three's vectors.

import { Vector3 } from 'three';

/** Of a link that covers something. */
export const FADED = 0.25;
const FADE_MS = 200;
/** A link stays transparent so long after it covers nothing more. */
const HOLD_MS = 400;
/** Around the bead and the goal. */
export const RING_PX = 24;

export interface Fade {
  readonly opacity: number;
  /** For how long the link has covered nothing. */
  readonly free_ms: number;
}

export const SOLID: Fade = { opacity: 1, free_ms: HOLD_MS };

/** The fade after some time. It jumps if the user wants less motion. */
export function faded(
  { opacity, free_ms }: Fade,
  covers: boolean,
  elapsed_ms: number,
  jumps = false,
): Fade {
  const step = jumps ? 1 : ((1 - FADED) * elapsed_ms) / FADE_MS;
  if (covers) return { opacity: Math.max(FADED, opacity - step), free_ms: 0 };
  const free = Math.min(HOLD_MS, free_ms + elapsed_ms);
  return { opacity: free < HOLD_MS ? opacity : Math.min(1, opacity + step), free_ms: free };
}

/** Whether it stays as it is. */
export const isSettled = ({ opacity }: Fade, covers: boolean): boolean =>
  opacity === (covers ? FADED : 1);

/** A round solid between two points. */
export interface Rod {
  readonly from: Vector3;
  readonly to: Vector3;
  readonly radius_m: number;
}

const clamp = (share: number): number => Math.min(1, Math.max(0, share));
const ray = new Vector3();
const axis = new Vector3();
const apart = new Vector3();

/**
 * Whether a rod lies in front of a ring around a place. `ringPerM` is the ring's radius divided by the distance from
 * the eye.
 */
export function covers(
  { from, to, radius_m }: Rod,
  eye: Vector3,
  at: Vector3,
  ringPerM: number,
): boolean {
  // The points of rod and ray that are nearest to each other.
  ray.subVectors(at, eye);
  axis.subVectors(to, from);
  apart.subVectors(from, eye);
  const [along2, ray2, across] = [axis.lengthSq(), ray.lengthSq(), axis.dot(ray)];
  const det = along2 * ray2 - across * across;
  const start = det > 0 ? (across * ray.dot(apart) - ray2 * axis.dot(apart)) / det : 0;
  const onRay = clamp((ray.dot(apart) + clamp(start) * across) / ray2);
  const onRod = along2 > 0 ? clamp((onRay * across - axis.dot(apart)) / along2) : 0;
  const gap_m = apart.addScaledVector(axis, onRod).addScaledVector(ray, -onRay).length();
  return gap_m < radius_m + ringPerM * onRay * Math.sqrt(ray2);
}
