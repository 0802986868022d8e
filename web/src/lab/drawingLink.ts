// A map's drawing in an experiment link, so that the link works on a server that does not have the map.

import { MAX_SVG_BYTES, SHIPPED_MAPS } from '../net/protocol.gen';
import { addMap, svgOf } from './maps';

/** Longer links are cut by some programs. */
const MOST_CHARACTERS = 4000;
const FORMAT = 'deflate-raw';

const through = (data: BlobPart, stream: CompressionStream | DecompressionStream) =>
  new Blob([data]).stream().pipeThrough(stream);

/** The drawing in letters, digits, - and _ (base64url of raw deflate). */
export async function packed(svg: string): Promise<string> {
  const stream = through(svg, new CompressionStream(FORMAT));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  const text = btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(''));
  return text.replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
}

/** The drawing of a packed text; throws an error if it is damaged or too large. */
export async function unpacked(text: string): Promise<string> {
  const parts: Uint8Array<ArrayBuffer>[] = [];
  let size = 0;
  try {
    const binary = atob(text.replaceAll('-', '+').replaceAll('_', '/'));
    const bytes = Uint8Array.from(binary, (letter) => letter.charCodeAt(0));
    const reader = through(bytes, new DecompressionStream(FORMAT)).getReader();
    for (let part = await reader.read(); !part.done; part = await reader.read()) {
      parts.push(part.value);
      size += part.value.length;
      // A short text can hold a very long drawing.
      if (size > MAX_SVG_BYTES) break;
    }
  } catch {
    throw new Error('the drawing in the link is damaged.');
  }
  if (size > MAX_SVG_BYTES) throw new Error('the drawing in the link is too large.');
  return new Blob(parts).text();
}

/** What a link contains of a map besides its name. */
export interface DrawingForLink {
  /** The packed drawing, if other servers may not have the map. */
  readonly text?: string;
  /** What the user should know. */
  readonly remark?: string;
}

export async function drawingForLink(map: string): Promise<DrawingForLink> {
  if (SHIPPED_MAPS.includes(map)) return {};
  const svg = await svgOf(map).catch(() => undefined);
  if (svg === undefined)
    return { remark: 'This server no longer has the map, so it cannot load it.' };
  const text = await packed(svg);
  return text.length <= MOST_CHARACTERS
    ? { text, remark: 'It also contains the drawing of the map.' }
    : { remark: 'The drawing of the map is too long for it: other servers do not know this map.' };
}

/** The name of the map with a packed drawing: one of this server's, or a new one with the wished name if that is free. */
export async function drawnMap(
  wished: string,
  text: string,
  maps: readonly string[],
): Promise<string> {
  const svg = await unpacked(text);
  const added = maps.filter((map) => !SHIPPED_MAPS.includes(map));
  // Most likely the one of the same name.
  for (const map of added.toSorted((a, b) => Number(b === wished) - Number(a === wished))) {
    const other = await svgOf(map).catch(() => undefined);
    if (other === svg) return map;
  }
  return (await addMap(new File([svg], `${wished}.svg`))).name;
}
