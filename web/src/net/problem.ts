// The server's refusals.

/** The part of a policy's reference after its name, `NAME@HASH`. */
const HASH = /@[0-9a-f]{16}\b/g;

export interface Problem {
  /** With the names of policies in place of their references. */
  readonly detail: string;
  /** The field of the request that is wrong. */
  readonly field?: string | undefined;
}

/** The problem document of a response; empty if it has none, as from a proxy. */
export async function problemOf(response: Response): Promise<Partial<Problem>> {
  try {
    const { detail, field } = (await response.json()) as Problem;
    return { detail: detail.replaceAll(HASH, ''), field };
  } catch {
    return {};
  }
}

/** The message of what was thrown. */
export const reasonText = (reason: unknown): string =>
  reason instanceof Error ? reason.message : String(reason);
