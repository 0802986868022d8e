// What the server says against a request.

/** What a refusal says: the `detail` of a problem, if there is one. */
export function problemText(body: unknown): string | undefined {
  return typeof body === 'object' && body && 'detail' in body && typeof body.detail === 'string'
    ? body.detail
    : undefined;
}
