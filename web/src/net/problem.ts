// The server's refusals.

const HASH = /@[0-9a-f]{16}\b/g;

/** A text of the server with the names of policies in place of their references, `NAME@HASH`. */
export const withoutHashes = (text: string): string => text.replaceAll(HASH, '');

/** The `detail` of a problem document, if it has one. */
export function problemText(body: unknown): string | undefined {
  return typeof body === 'object' && body && 'detail' in body && typeof body.detail === 'string'
    ? withoutHashes(body.detail)
    : undefined;
}

/** The field of the request that a problem document names, if it names one. */
export function problemField(body: unknown): string | undefined {
  return typeof body === 'object' && body && 'field' in body && typeof body.field === 'string'
    ? body.field
    : undefined;
}
