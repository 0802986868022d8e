// A map of one's own: its drawing goes to the server, which reads it and names it.

import { post } from '../../net/requests';
import { MAX_SVG_BYTES } from '../../net/protocol.gen';

/** The name by which it is loaded from now on; fails with the sentence to show. */
export async function addMap(file: Blob): Promise<string> {
  if (file.size > MAX_SVG_BYTES) {
    throw new Error('A drawing may have 1 MiB at most; this one is larger.');
  }
  const { name } = await post<{ readonly name: string }>('/api/maps', file, 'image/svg+xml');
  return name;
}
