// The server's refusals.

/** The `detail` of a problem document, if it has one. */
export function problemText(body: unknown): string | undefined {
  return typeof body === 'object' && body && 'detail' in body && typeof body.detail === 'string'
    ? body.detail
    : undefined;
}

/** The field of the request that a problem document names, if it names one. */
export function problemField(body: unknown): string | undefined {
  return typeof body === 'object' && body && 'field' in body && typeof body.field === 'string'
    ? body.field
    : undefined;
}
