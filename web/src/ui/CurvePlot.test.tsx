import { createSignal } from 'solid-js';
import { render } from 'solid-js/web';
import { afterEach, expect, it, vi } from 'vitest';
import { page, userEvent } from 'vitest/browser';
import type uPlot from 'uplot';
import { CurvePlot } from './CurvePlot';

let end = (): void => undefined;
afterEach(() => {
  end();
  document.body.replaceChildren();
});

it('reads the curve under the pointer, also when more of it comes', async () => {
  const [data, setData] = createSignal<uPlot.AlignedData>([
    [0, 1, 2],
    [5, 6, 7],
  ]);
  const onCursor = vi.fn<(index: number | undefined) => void>();
  const context = {
    lines: [{ label: 'One', color: 'magnet-line' as const }],
    xRange: (): [number, number] => [0, 4],
    yRange: (): [number, number] => [0, 10],
    xText: String,
    yText: String,
    onCursor,
  };
  const root = document.createElement('div');
  root.style.cssText = 'width: 400px; height: 200px; display: grid';
  document.body.append(root);
  end = render(
    () => <CurvePlot title="Curve" unit="m" name="Curve" context={context} data={data()} />,
    root,
  );
  await userEvent.hover(page.getByRole('img', { name: 'Curve' }));
  await expect.poll(() => onCursor.mock.lastCall?.[0]).toBe(2);
  setData([
    [0, 1, 2, 3, 4],
    [5, 6, 7, 8, 9],
  ]);
  await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
  expect(onCursor.mock.lastCall?.[0]).toBe(2);
  const line = root.querySelector('.u-cursor-x');
  expect(line?.classList.contains('u-off'), 'the line at the pointer').toBe(false);
  await userEvent.unhover(page.getByRole('img', { name: 'Curve' }));
  await expect.poll(() => onCursor.mock.lastCall?.[0]).toBeUndefined();
});
