// The viewer would post usage statistics and look for examples on Rerun's servers, and has no option against it.
// It is told no here, before a request is made. The page's policy would stop it too, but with an error each time.

/** A `fetch` that asks one origin; others it answers itself, as forbidden. */
export function keptAtHome(original: typeof fetch, origin: string): typeof fetch {
  return (input, init) => {
    const address = new URL(input instanceof Request ? input.url : input, origin);
    return address.origin === origin
      ? original(input, init)
      : Promise.resolve(new Response(null, { status: 403 }));
  };
}
