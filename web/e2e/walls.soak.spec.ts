// Frames of a page with moving walls, with its budgets: run nothing else meanwhile.
// `npm run soak -- walls.soak`

import { Lab, expect, test } from './fixtures';
import { writeReport } from './support/growth';
import { type Figures, Meter, figuresOf, overruns, summaryOf } from './support/meter';
import { until } from './support/wait';

const AMPLITUDES_M = [0, 0.006, 0.012];
const TICKS = 1250;
/** Of the plan, which needs no graphics card. */
const FRAMES_LEAST_PER_S = 55;

test('keeps its frames while the walls move', async ({ page, newSession }) => {
  const meter = await Meter.attach(page);
  const all: Record<string, Figures> = {};
  for (const view of ['Plan', '3-D']) {
    for (const amplitude_m of AMPLITUDES_M) {
      const map = `map=colon-folds&controller=attractor&seed=1&peristalsis_amplitude_m=${amplitude_m}`;
      const lab = await Lab.attach(page, `${newSession().url}#v=1&${map}`);
      await until('the experiment', () => lab.scene.map === 'colon-folds');
      await lab.page.getByRole('radio', { name: view }).check();
      await lab.run();
      await lab.later(TICKS / 4);
      await meter.start();
      await lab.later(TICKS);
      const figures = figuresOf([await meter.stop()]);
      await lab.pause();
      all[`${view}, ${amplitude_m * 1000} mm`] = figures;
      console.log(`${view}, ${amplitude_m * 1000} mm: ${summaryOf(figures)}`);
    }
  }
  await writeReport('walls', all);
  for (const [name, figures] of Object.entries(all)) {
    if (!name.startsWith('Plan')) continue;
    expect(overruns(figures), name).toEqual([]);
    expect(figures.frames_per_s, name).toBeGreaterThan(FRAMES_LEAST_PER_S);
  }
});
