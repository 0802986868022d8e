import { expect, it } from 'vitest';
import { eventAt } from '../../lab/testingFacts';
import { page } from 'vitest/browser';
import { fakeLab, show } from '../../lab/testingLab';
import LessonsPanel from './LessonsPanel';
import TaskBar from './TaskBar';

const button = (name: string | RegExp) => page.getByRole('button', { name });

it('ends the settings of a lesson with it', async () => {
  const { lab, server } = fakeLab();
  show(() => <LessonsPanel lab={lab} />);
  await expect.poll(() => lab.state()).toBeDefined();
  server.lists({ maps: ['posts', 'colon', 'open'] });
  await button(/^The law to the letter/).click();
  await page.getByRole('radio').first().click();
  await button('Next').click();
  await button('Set it up').click();
  await expect.poll(() => server.command('load_scenario')).toBeDefined();
  server.load();
  await expect.poll(() => lab.edits.shown()?.switching_law).toBe('literal');
  await button('All lessons').click();
  await expect.poll(() => server.command('configure')?.parameters).toEqual(lab.scene()?.defaults);
});

it('counts a lesson that was read to its end, whether it is finished or left', async () => {
  const { lab, server } = fakeLab();
  show(() => <LessonsPanel lab={lab} />);
  await expect.poll(() => lab.state()).toBeDefined();
  server.lists({ maps: ['posts', 'colon', 'open'] });
  await button(/^Meet the magnet/).click();
  await page.getByRole('radio').first().click();
  await button('Next').click();
  await button('Set it up').click();
  await expect.poll(() => server.command('load_scenario')).toBeDefined();
  server.load();
  await expect.element(page.getByText('0 of 3 done')).toBeVisible();
  server.state({ tick: 1, sim_time_s: 0.008, tool_m: [0, -0.36, 0.1] });
  await expect.poll(() => lab.state()?.tick).toBe(1);
  server.tell({ type: 'event', ...eventAt(1250, 'delivered') });
  server.state({ tick: 1250, sim_time_s: 10, tool_m: [0.15, -0.36, 0.1] });
  await expect.element(page.getByText('3 of 3 done')).toBeVisible();
  await button('Next').click();
  await expect.element(page.getByText('Right', { exact: true })).toBeVisible();
  await expect.element(page.getByText(/^Paper of Tariverdi/)).toBeVisible();
  await expect.element(page.getByText('Lesson done: 1 of 12.')).toBeVisible();
  await button('All lessons').click();
  await expect.element(button(/^Meet the magnet.*done/i)).toBeVisible();
});

it('shows which lesson is next, and the link of each for a class', async () => {
  const { lab } = fakeLab();
  show(() => <LessonsPanel lab={lab} />);
  await expect.element(button(/^Meet the magnet.*next/)).toBeVisible();
  await button('Link to Lift-off').click();
  await expect
    .element(page.getByLabelText('Link: Lesson Lift-off'))
    .toHaveValue(`${window.location.origin}/copy/#lesson=lift-off`);
  await button('Link to Lift-off').click();
  await expect.element(page.getByLabelText('Link: Lesson Lift-off')).not.toBeInTheDocument();
});

it('counts no delivery to a goal that the user has moved, and says so', async () => {
  const { lab, server } = fakeLab();
  show(() => <LessonsPanel lab={lab} />);
  await expect.poll(() => lab.state()).toBeDefined();
  server.lists({ maps: ['posts', 'colon', 'open'] });
  await button(/^Meet the magnet/).click();
  await page.getByRole('radio').first().click();
  await button('Next').click();
  await button('Set it up').click();
  await expect.poll(() => server.command('load_scenario')).toBeDefined();
  server.load();
  const moved = page.getByText('The goal is at another place now', { exact: false });
  await expect.element(button('Set it up again')).toBeVisible();
  await expect.element(moved).not.toBeInTheDocument();
  server.state({ tick: 1, sim_time_s: 0.008, tool_m: [0, -0.36, 0.1] });
  const placed = { code: 'goal_placed', x_m: 0.1, y_m: -0.36 } as const;
  server.tell({ type: 'event', ...eventAt(100, 'goal', placed) });
  server.tell({ type: 'event', ...eventAt(1250, 'delivered') });
  server.state({ tick: 1250, sim_time_s: 10, goal_m: [0.1, -0.36, 0], tool_m: [0.1, -0.36, 0.1] });
  await expect.element(moved).toBeVisible();
  await expect.element(page.getByText('2 of 3 done')).toBeVisible();
});

it('has the next task for a phone while an experiment of the lesson is on the page', async () => {
  const { lab, server } = fakeLab();
  show(() => (
    <>
      <TaskBar lab={lab}>Steered by</TaskBar>
      <LessonsPanel lab={lab} />
    </>
  ));
  await expect.poll(() => lab.state()).toBeDefined();
  server.lists({ maps: ['posts', 'colon', 'open'] });
  await expect.element(page.getByText('Steered by')).toBeVisible();
  await button(/^Meet the magnet/).click();
  await page.getByRole('radio').first().click();
  await button('Next').click();
  await button('Set it up').click();
  await expect.poll(() => server.command('load_scenario')).toBeDefined();
  server.load();
  const bar = button(/press Run or the space bar 0 of 3$/);
  await bar.click();
  expect(lab.panel()).toBe('learn');
  await expect.element(bar).toHaveAttribute('aria-expanded', 'true');
  server.state({ tick: 1, sim_time_s: 0.008, tool_m: [0, -0.36, 0.1] });
  await expect.poll(() => lab.state()?.tick).toBe(1);
  server.state({ tick: 1250, sim_time_s: 10, tool_m: [0.15, -0.36, 0.1] });
  await expect.element(button(/^Deliver.* 2 of 3$/)).toBeVisible();
  server.scene({ trial: 7 });
  await expect.element(page.getByText('Steered by')).toBeVisible();
});

it('goes on with the first lesson after this one that is not done', async () => {
  localStorage.setItem(
    'ferry.lessons',
    JSON.stringify({ choices: { magnet: 'edge' }, done: ['magnet', 'lift-off', 'lose'] }),
  );
  const { lab } = fakeLab();
  show(() => <LessonsPanel lab={lab} />);
  await expect.poll(() => lab.state()).toBeDefined();
  await button(/^Meet the magnet \(done\)/).click();
  await button('Next').click();
  await button('Next').click();
  await button('Next lesson').click();
  await expect.element(page.getByRole('heading', { name: 'The threshold T' })).toBeVisible();
  localStorage.removeItem('ferry.lessons');
});
