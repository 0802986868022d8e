// Generated from server/protocol.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews it.

import type { Polygon, PositionerKind, Rect } from './experiment.gen';

/**
 * A passage between two rooms of a map.
 */
export type NarrowPlace = { 
/**
 * Distance between the walls.
 */
width_m: number, x_m: number, y_m: number, };

/**
 * What a drawing holds.
 */
export type MapFacts = { width_m: number, height_m: number, walls: number, 
/**
 * Number of connected parts; the bead cannot pass between them.
 */
regions: number, 
/**
 * Area of these parts, m².
 */
free_m2: number, 
/**
 * Diameter of the largest circle between the walls.
 */
widest_m: number, 
/**
 * The narrowest passage; `null` if there is one room only.
 */
narrowest: NarrowPlace | null, 
/**
 * Share of the free area that the tool reaches, from 0 to 1.
 */
reached_share: number, 
/**
 * Elements that had to be changed or left out, one sentence each.
 */
repairs: Array<string>, };

/**
 * A map that was added.
 */
export type MapReport = { 
/**
 * Name of the new map.
 */
name: string, width_m: number, height_m: number, walls: number, 
/**
 * Number of connected parts; the bead cannot pass between them.
 */
regions: number, 
/**
 * Area of these parts, m².
 */
free_m2: number, 
/**
 * Diameter of the largest circle between the walls.
 */
widest_m: number, 
/**
 * The narrowest passage; `null` if there is one room only.
 */
narrowest: NarrowPlace | null, 
/**
 * Share of the free area that the tool reaches, from 0 to 1.
 */
reached_share: number, 
/**
 * Elements that had to be changed or left out, one sentence each.
 */
repairs: Array<string>, };

/**
 * A drawing as a map, which is not added.
 */
export type MapCheck = { 
/**
 * The passages between its rooms, the narrowest first, at most 30.
 */
passages: Array<NarrowPlace>, workspace: Rect, 
/**
 * What moves the magnet over this map.
 */
positioner: PositionerKind, 
/**
 * Its walls, in metres, without the border.
 */
outlines: Array<Polygon>, width_m: number, height_m: number, walls: number, 
/**
 * Number of connected parts; the bead cannot pass between them.
 */
regions: number, 
/**
 * Area of these parts, m².
 */
free_m2: number, 
/**
 * Diameter of the largest circle between the walls.
 */
widest_m: number, 
/**
 * The narrowest passage; `null` if there is one room only.
 */
narrowest: NarrowPlace | null, 
/**
 * Share of the free area that the tool reaches, from 0 to 1.
 */
reached_share: number, 
/**
 * Elements that had to be changed or left out, one sentence each.
 */
repairs: Array<string>, };
