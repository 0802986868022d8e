// Distances of the pixels of a picture from those that are set: Felzenszwalb and Huttenlocher, "Distance Transforms of
// Sampled Functions" (2012). Pure.

const FAR = 1e9;

/** Squared distances along a line of `count` values with a step between them, in place. */
function alongLine(values: Float64Array, first: number, step: number, count: number): void {
  const line = new Float64Array(count);
  const lowest = new Int32Array(count);
  const from = new Float64Array(count + 1);
  for (let i = 0; i < count; i++) line[i] = values[first + i * step] ?? FAR;
  let last = 0;
  from[0] = -Infinity;
  from[1] = Infinity;
  for (let i = 1; i < count; i++) {
    const height = (line[i] ?? 0) + i * i;
    let start: number;
    for (;;) {
      const j = lowest[last] ?? 0;
      start = (height - (line[j] ?? 0) - j * j) / (2 * (i - j));
      if (start > (from[last] ?? 0)) break;
      last -= 1;
    }
    last += 1;
    lowest[last] = i;
    from[last] = start;
    from[last + 1] = Infinity;
  }
  let part = 0;
  for (let i = 0; i < count; i++) {
    while ((from[part + 1] ?? Infinity) < i) part += 1;
    const j = lowest[part] ?? 0;
    values[first + i * step] = (i - j) ** 2 + (line[j] ?? 0);
  }
}

/** Of each pixel, row after row. */
export function distancesFrom(
  isSet: (pixel: number) => boolean,
  columns: number,
  rows: number,
): Float64Array {
  const squares = Float64Array.from({ length: columns * rows }, (_, i) => (isSet(i) ? 0 : FAR));
  for (let x = 0; x < columns; x++) alongLine(squares, x, columns, rows);
  for (let y = 0; y < rows; y++) alongLine(squares, y * columns, 1, columns);
  return squares.map(Math.sqrt);
}
