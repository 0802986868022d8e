// Pictures of a grid: one pixel per cell.

export type Rgba = readonly [number, number, number, number];

/** RGBA of a grid whose first row is the lowest one. In the picture the upper row is the first. */
export function gridPixels(
  columns: number,
  rows: number,
  colourOf: (cell: number) => Rgba,
): Uint8ClampedArray<ArrayBuffer> {
  const pixels = new Uint8ClampedArray(4 * columns * rows);
  for (let cell = 0; cell < columns * rows; cell++) {
    const row = rows - 1 - Math.floor(cell / columns);
    pixels.set(colourOf(cell), 4 * (row * columns + (cell % columns)));
  }
  return pixels;
}

export function imageOf(
  pixels: Uint8ClampedArray<ArrayBuffer>,
  columns: number,
): HTMLCanvasElement {
  const data = new ImageData(pixels, columns);
  const image = document.createElement('canvas');
  image.width = data.width;
  image.height = data.height;
  image.getContext('2d')?.putImageData(data, 0, 0);
  return image;
}
