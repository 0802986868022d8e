import { expect, it } from 'vitest';
import { page } from 'vitest/browser';
import { branchOf, comparisonOf } from '../../lab/testing';
import { fakeLab, show } from '../../lab/testingLab';
import { createTimeAxis } from '../../lab/timeAxis';
import CompareLine from './CompareLine';

it('has a row for each controller up to its end, with marks side by side, and moves the ghosts', async () => {
  const { lab, server } = fakeLab();
  await page.viewport(1280, 800);
  const samples = (count: number): [number, number, number, number][] =>
    Array.from({ length: count }, () => [0, 0, 0, 0]);
  const comparison = comparisonOf(1000, [
    branchOf('rl', samples(300), { delivered_tick: 2250 }),
    branchOf('errt', samples(300), { delivered_tick: 2250 }),
    branchOf('attractor', samples(100), { phase: { code: 'lifted_off', text: '' } }),
  ]);
  server.tell({ type: 'comparison', ...comparison });
  show(() => (
    <div style={{ width: '800px' }}>
      <CompareLine
        lab={lab}
        comparison={comparison}
        axis={createTimeAxis(lab, () => comparison)}
        tick_s={0.008}
      />
    </div>
  ));
  const rl = page.getByRole('img', { name: 'RL: delivered after 10.0 s' });
  const errt = page.getByRole('img', { name: 'ERRT: delivered after 10.0 s' });
  const attractor = page.getByRole('img', { name: 'Attractor: lifted off after 4.0 s' });
  await expect.element(attractor).toBeInTheDocument();
  const left = (mark: typeof rl): number => parseFloat((mark.element() as HTMLElement).style.left);
  expect(Math.abs(left(rl) - left(errt))).toBe(24);
  const widths = [...document.querySelectorAll<HTMLElement>('.branch-rows > span')];
  // The axis has 15 s from the moment of the comparison.
  expect(widths.map((row) => Math.round(parseFloat(row.style.width)))).toEqual([67, 67, 27]);
  await expect.poll(() => Math.round(left(attractor))).toBe(Math.round((800 * 4) / 15));
  const slider = page.getByLabelText('Time of the ghosts');
  await slider.fill('1100');
  expect(lab.comparison.tick()).toBe(1100);
});
