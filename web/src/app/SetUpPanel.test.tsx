import { expect, it } from 'vitest';
import { page, userEvent } from 'vitest/browser';
import { fakeLab, show } from '../lab/testingLab';
import { createPageExperiment } from '../lab/pageExperiment';
import { createMapOpener } from '../features/maps/opener';
import SetUpPanel from './SetUpPanel';

const LARGEST_SEED = Number.MAX_SAFE_INTEGER;

it('shows a long seed as a whole in the narrowest inspector', async () => {
  const { lab, server } = fakeLab();
  const links = createPageExperiment(lab, window);
  show(() => (
    <aside class="inspector-panel" style={{ width: '300px' }}>
      <SetUpPanel lab={lab} links={links} opener={createMapOpener(lab)} onTrain={() => undefined} />
    </aside>
  ));
  const seed = page.getByLabelText('Seed', { exact: true });
  await seed.fill(String(LARGEST_SEED));
  await userEvent.keyboard('{Enter}');
  await expect.poll(() => server.command('reset')?.seed).toBe(LARGEST_SEED);
  server.scene({ seed: LARGEST_SEED });
  const input = seed.element() as HTMLInputElement;
  input.blur();
  await expect.element(seed).toHaveValue(String(LARGEST_SEED));
  await expect.poll(() => input.scrollWidth - input.clientWidth).toBeLessThanOrEqual(0);
});
