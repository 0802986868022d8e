import { expect, it } from 'vitest';
import { eventAt } from '../../lab/testingFacts';
import { page } from 'vitest/browser';
import { fakeLab, show } from '../../lab/testingLab';
import EventsPanel from './EventsPanel';

it('closes when the trial restarts', async () => {
  const { lab, server } = fakeLab();
  show(() => <EventsPanel lab={lab} />);
  const card = page.getByRole('dialog');
  await expect.poll(() => lab.scene()).toBeDefined();
  const placed = { code: 'goal_placed', x_m: 0.1, y_m: -0.3 } as const;
  server.tell({ type: 'event', ...eventAt(1, 'goal', placed) });
  await expect.poll(() => lab.marks().length).toBe(1);
  lab.inspect(lab.marks()[0]);
  await expect.element(card).toHaveTextContent('Goal placed');
  await expect.element(card).toHaveFocus();
  server.scene({ trial: 1 });
  await expect.element(card).not.toBeInTheDocument();
});
