import { expect, it } from 'vitest';
import { page } from 'vitest/browser';
import { fakeLab, show } from '../../lab/testingLab';
import { LessonsPanel } from './LessonsPanel';

const button = (name: string | RegExp) => page.getByRole('button', { name });

it('ends the settings of a lesson with it', async () => {
  const { lab, server } = fakeLab();
  show(() => <LessonsPanel lab={lab} />);
  await expect.poll(() => lab.state()).toBeDefined();
  server.scene({ maps: ['posts', 'colon', 'open'] });
  await button(/^The law to the letter/).click();
  await page.getByRole('radio').first().click();
  await button('Next').click();
  await button('Set it up').click();
  await expect.poll(() => server.command('load_scenario')).toBeDefined();
  server.load();
  await expect.poll(() => lab.tuning()?.switching_law).toBe('literal');
  await button('All lessons').click();
  await expect.poll(() => server.command('configure')?.parameters).toEqual(lab.scene()?.defaults);
});
