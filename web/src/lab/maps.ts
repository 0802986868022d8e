// The user's own map: its drawing is sent to the server, which reads and names it.

import { addressOf } from '../net/base';
import { getText, post } from '../net/requests';
import { MAX_SVG_BYTES, type MapCheck, type MapFacts, type MapReport } from '../net/protocol.gen';
import { counted, fixed, millimetres } from '../ui/format';

/** Leaves room for an ending. */
const NAME_LENGTH = 34;

/** The name of a file as the name of a map: `My maze.svg` becomes `my-maze`. */
export function mapName(file: string): string {
  return file
    .replace(/\.svg$/i, '')
    .normalize('NFKD')
    .replaceAll(/\p{M}/gu, '')
    .toLowerCase()
    .replaceAll(/[^a-z0-9_]+/g, '-')
    .replaceAll(/^[-_]+|-+$/g, '')
    .slice(0, NAME_LENGTH);
}

/** The name, or with a number if a map has it: `two-rooms-2`. */
export function freeName(name: string, maps: readonly string[]): string {
  let free = name;
  for (let number = 2; maps.includes(free); number += 1) free = `${name}-${number}`;
  return free;
}

/** A drawing with a smaller share of reached area is offered a move. */
const MOST = 0.98;

/** Whether a part of the map is out of the arm's reach. */
export const isOutOfReach = ({ reached_share }: MapFacts): boolean => reached_share < MOST;

/** What keeps the bead or the arm from a part of the map, one sentence each. */
export function faultWords(facts: MapFacts): string[] {
  const { regions, reached_share } = facts;
  const sentences: string[] = [];
  if (regions === 0) sentences.push('Nowhere is there room for the bead.');
  else if (regions > 1) {
    sentences.push(`${regions} separate regions: the bead cannot pass from one to the other.`);
  }
  if (isOutOfReach(facts)) {
    sentences.push(`The arm reaches ${(100 * reached_share).toFixed(0)} % of the free area.`);
  }
  return sentences;
}

/** What the drawing holds, one sentence each. */
export function reportWords(facts: MapFacts): string[] {
  const { width_m, height_m, walls, narrowest, repairs } = facts;
  const size = `${(1000 * width_m).toFixed(0)} × ${millimetres(height_m)}`;
  const sentences = [`${size}, ${counted(walls, 'wall')}.`, ...faultWords(facts)];
  if (narrowest) {
    const { x_m, y_m } = narrowest;
    sentences.push(
      `The narrowest place is ${millimetres(narrowest.width_m)} wide, at x ${fixed(x_m, 2)}, y ${fixed(y_m, 2)} m.`,
    );
  }
  return [...sentences, ...repairs.map((repair) => `Repaired: ${repair}.`)];
}

/** Throws an error with the message to show if a drawing is larger than the server takes. */
export function refuseLarge(file: File): void {
  if (file.size > MAX_SVG_BYTES) {
    throw new Error('This drawing is too large: the limit is 1 MiB.');
  }
}

/** What a drawing would be as a map; throws an error with the message to show. */
export function checkOf(svg: string): Promise<MapCheck> {
  return post<MapCheck>('/api/map-checks', svg, 'image/svg+xml');
}

const svgPath = (map: string): string => `/api/maps/${encodeURIComponent(map)}`;

/** The address of the drawing of a map of the server. */
export const svgAddress = (map: string): string => addressOf(svgPath(map));

/** The drawing of a map of the server; throws an error with the message to show. */
export const svgOf = (map: string): Promise<string> => getText(svgPath(map));

/** The walls and the size of a map of the server; throws an error with the message to show. */
export const checkOfMap = async (map: string): Promise<MapCheck> => checkOf(await svgOf(map));

/**
 * Returns what the server says about the new map; throws an error with the message to show. `fit` moves the drawing into
 * the arm's reach and shrinks it if it is larger.
 */
export async function addMap(file: File, fit = false): Promise<MapReport> {
  refuseLarge(file);
  const name = encodeURIComponent(mapName(file.name));
  return post<MapReport>(
    fit ? `/api/maps?name=${name}-moved&fit=true` : `/api/maps?name=${name}`,
    file,
    'image/svg+xml',
  );
}
