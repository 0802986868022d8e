// A flight of the camera from one pose to another.

import { Spherical, Vector3 } from 'three';
import { distance, type TableView } from '../lab/geometry';
import type { Size } from '../ui/size';

/** Of all flights. */
const FLIGHT_MS = 320;
/** From exactly above, the picture would have no defined upper side. */
const PLAN_POLAR_RAD = 1e-6;

/** Where the camera is: its target, its place on the sphere around it, and the shift of the picture to the right. */
export interface Pose {
  readonly target: Vector3;
  /** With the angles of a vertical axis. */
  readonly seat: Spherical;
  /** As a share of the picture's width. */
  shift: number;
}

/** What the plan view shows. Its canvas and that of the scene have the same middle. */
export interface PlanPicture extends TableView {
  readonly size: Size;
}

/** The camera from above whose picture of the table is that of the plan view. */
export function planPose(plan: PlanPicture, { height }: Size, tangent: number): Pose | undefined {
  const { size } = plan;
  const middle = plan.toWorld([size.width / 2, size.height / 2]);
  const [from, to] = [plan.toPx([0, 0]), plan.toPx([1, 0])];
  if (!middle || !from || !to) return undefined;
  const away_m = height / (2 * tangent * distance(from, to));
  const turn_rad = Math.atan2(to[1] - from[1], to[0] - from[0]);
  const seat = new Spherical(away_m, PLAN_POLAR_RAD, turn_rad);
  return { target: new Vector3(...middle, 0), seat, shift: 0 };
}

/** Slow at both ends. */
const eased = (share: number): number => share * share * (3 - 2 * share);
const mix = (from: number, to: number, share: number): number => from + share * (to - from);

export class Flight {
  private readonly from: Pose;
  private elapsed_ms = 0;

  constructor(
    /** Written in place. */
    private readonly pose: Pose,
    private readonly to: Pose,
  ) {
    const { target, seat, shift } = pose;
    this.from = { target: target.clone(), seat: seat.clone(), shift };
    // The shorter way round.
    const turns = Math.round((to.seat.theta - seat.theta) / (2 * Math.PI));
    this.from.seat.theta += 2 * Math.PI * turns;
  }

  /** Returns whether it is over. */
  advance(elapsed_ms: number): boolean {
    this.elapsed_ms += elapsed_ms;
    const share = Math.min(1, this.elapsed_ms / FLIGHT_MS);
    const { from, to, pose } = this;
    const by = eased(share);
    pose.target.lerpVectors(from.target, to.target, by);
    pose.seat.radius = from.seat.radius * (to.seat.radius / from.seat.radius) ** by;
    pose.seat.phi = mix(from.seat.phi, to.seat.phi, by);
    pose.seat.theta = mix(from.seat.theta, to.seat.theta, by);
    pose.shift = mix(from.shift, to.shift, by);
    return share === 1;
  }
}
