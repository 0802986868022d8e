// The viewer would send usage statistics to Rerun's servers and load examples from there, and has no option against it.
// These requests are refused here. The page's security policy would also block them, but with an error each time.

/** A `fetch` for one origin. It answers requests to other origins itself, as forbidden. */
export function keptAtHome(original: typeof fetch, origin: string): typeof fetch {
  return (input, init) => {
    const address = new URL(input instanceof Request ? input.url : input, origin);
    return address.origin === origin
      ? original(input, init)
      : Promise.resolve(new Response(null, { status: 403 }));
  };
}
