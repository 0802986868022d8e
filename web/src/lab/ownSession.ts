// A session of the visitor's own.

import { addressOf } from '../net/base';
import { post } from '../net/requests';

/** Opens one and goes there; `rest` follows the path of its page. Throws the server's refusal, if it is full. */
export async function openOwn(rest = ''): Promise<void> {
  const { id } = await post<{ readonly id: string }>('/api/own-sessions');
  window.location.assign(addressOf(`/s/${id}${rest}`));
}
