// The server's refusals.

/** The `detail` of a problem document, if it has one. */
export function problemText(body: unknown): string | undefined {
  return typeof body === 'object' && body && 'detail' in body && typeof body.detail === 'string'
    ? body.detail
    : undefined;
}
