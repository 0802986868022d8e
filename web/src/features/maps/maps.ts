// The user's own map: its drawing is sent to the server, which reads and names it.

import { post } from '../../net/requests';
import { MAX_SVG_BYTES } from '../../net/protocol.gen';

/** Returns the name for loading the map; throws an error with the message to show. */
export async function addMap(file: Blob): Promise<string> {
  if (file.size > MAX_SVG_BYTES) {
    throw new Error('This drawing is too large: the limit is 1 MiB.');
  }
  const { name } = await post<{ readonly name: string }>('/api/maps', file, 'image/svg+xml');
  return name;
}
