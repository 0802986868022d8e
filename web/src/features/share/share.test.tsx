// Experiment links and presets.

import { afterEach, expect, it } from 'vitest';
import { page } from 'vitest/browser';
import { createPageExperiment } from '../../lab/pageExperiment';
import { PlaceNotice } from '../../lab/PlaceNotice';
import { sceneOf } from '../../lab/testing';
import { fakeLab, show } from '../../lab/testingLab';
import { ExperimentNotice } from './ExperimentNotice';
import { PresetSelect } from './PresetSelect';
import { ShareButton } from './ShareButton';

const { parameters } = sceneOf('posts');
const button = (name: string) => page.getByRole('button', { name, exact: true });
const question = page.getByRole('alert', { name: 'Link' });

/** The link of the last page. */
let linkNow: () => string | undefined;

async function open() {
  const { lab, server } = fakeLab();
  show(() => {
    const links = createPageExperiment(lab, window);
    linkNow = links.now;
    return (
      // The popover is below the top bar.
      <div style={{ '--top': '300px' }}>
        <ExperimentNotice lab={lab} links={links} />
        <PresetSelect lab={lab} links={links} />
        <ShareButton
          session="anna"
          links={links}
          map={lab.scene()?.map}
          open={[{ title: 'This lesson', address: 'http://ferry/x', words: 'For a class' }]}
          files="Files"
        >
          More
        </ShareButton>
        <PlaceNotice lab={lab} place="playback" />
      </div>
    );
  });
  await expect.element(button('Share')).toBeEnabled();
  server.lists({ maps: ['posts', 'open', 'colon'] });
  return server;
}

afterEach(() => {
  window.location.hash = '';
});

it('has the experiment in its link, and copies it', async () => {
  const server = await open();
  server.scene({
    map: 'colon',
    parameters: { ...parameters, threshold_m: 0.08, fetch_radius_m: 0.015 },
  });
  server.state({ controller: 'errt', goal_m: [0.1, -0.3, 0] });
  await button('Share').click();
  const field = page.getByLabelText('Link: A copy for each');
  const link = (): string => (field.element() as HTMLInputElement).value;
  await expect.poll(link).toContain('controller=errt');
  for (const part of ['map=colon', 'goal=0.1,-0.3', 'threshold_m=0.08', 'fetch_radius_m=0.015']) {
    expect(link()).toContain(part);
  }
  expect(link()).toMatch(/\/copy\/#v=1&/);
  await expect
    .element(page.getByLabelText('Link: Watch this'))
    .toHaveValue(`${window.location.origin}/s/anna?watch`);
  await expect.element(page.getByLabelText('Link: This lesson')).toHaveValue('http://ferry/x');
  await button('Copy: A copy for each').click();
  await expect.element(page.getByText(/^(Copied\.|Selected: )/)).toBeVisible();
});

it('refuses a link to an unknown map', async () => {
  const server = await open();
  window.location.hash = '#v=1&map=liver&controller=errt&seed=1';
  await expect.element(question).toHaveTextContent(/map is “liver”/);
  await button('Dismiss the link').click();
  await expect.element(question).toHaveTextContent('');
  expect(server.sent).toEqual([]);
});

it("shows the server's refusal of a link", async () => {
  const server = await open();
  window.location.hash = '#v=1&map=posts&controller=errt&seed=1&friction=7';
  await expect.poll(() => server.command('load_scenario')?.parameters?.friction).toBe(7);
  server.refuse('map_refused', 'friction is 7, it must be 0 to 1');
  await expect.element(page.getByText('friction is 7, it must be 0 to 1')).toBeVisible();
});

it('loads a preset, and names it while it is unchanged', async () => {
  const server = await open();
  const preset = page.getByLabelText('Preset');
  await expect.element(preset).toHaveDisplayValue('Preset…');
  await preset.selectOptions('A shaken table, T = 3 cm');
  await expect.poll(() => server.command('load_scenario')).toBeDefined();
  const sent = server.command('load_scenario');
  expect(sent).toMatchObject({ map: 'open', parameters: { threshold_m: 0.03 } });
  expect(sent?.script?.length, 'kicks').toBe(4);
  server.load();
  await expect.poll(linkNow).toContain('map=open');
  await expect.element(preset).toHaveDisplayValue('A shaken table, T = 3 cm');
  server.scene({ parameters });
  await expect.element(preset).toHaveDisplayValue('Preset…');
});
