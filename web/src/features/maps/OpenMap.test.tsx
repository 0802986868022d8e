import { expect, it } from 'vitest';
import { page, userEvent } from 'vitest/browser';
import { PlaceNotice } from '../../lab/PlaceNotice';
import { fakeLab, refusal, show } from '../../lab/testingLab';
import { OpenMap } from './OpenMap';
import { createMapOpener } from './opener';

async function open() {
  const { lab, server } = fakeLab({
    'POST /api/maps': () => refusal('the drawing has no viewBox'),
  });
  show(() => (
    <>
      <OpenMap lab={lab} opener={createMapOpener(lab)} onTrain={() => undefined} />
      <PlaceNotice lab={lab} place="playback" />
    </>
  ));
  await expect.element(page.getByRole('button', { name: 'Open SVG…' })).toBeEnabled();
  return server;
}

const choose = (text: string) =>
  userEvent.upload(page.getByLabelText('Drawing of the map'), new File([text], 'mine.svg'));
const dismiss = page.getByRole('button', { name: 'Dismiss' });

it('shows why the server refuses a drawing, and loads nothing', async () => {
  const server = await open();
  await choose('<svg/>');
  await expect.element(page.getByText('the drawing has no viewBox')).toBeVisible();
  await dismiss.click();
  await expect.element(dismiss).not.toBeInTheDocument();
  expect(server.command('load_scenario')).toBeUndefined();
});

it('does not send a drawing that is too large', async () => {
  const server = await open();
  await choose(`<svg>${' '.repeat(1024 * 1024)}</svg>`);
  await expect.element(page.getByText('the limit is 1 MiB')).toBeVisible();
  expect(server.requests).toEqual([]);
  expect(server.command('load_scenario')).toBeUndefined();
});
