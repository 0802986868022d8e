/** An element of the page's HTML. */
export function part<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  rest = '',
): HTMLElementTagNameMap[K] {
  const found = document.querySelector<HTMLElementTagNameMap[K]>(tag + rest);
  if (!found) throw new Error(`The page has no ${tag}${rest}.`);
  return found;
}
