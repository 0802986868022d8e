// The list of events, and test cases from a file.

import { expect, it } from 'vitest';
import { eventAt } from '../../lab/testingFacts';
import { page, userEvent } from 'vitest/browser';
import { PlaceNotice } from '../../lab/PlaceNotice';
import { fakeLab, show } from '../../lab/testingLab';
import { openCase } from './cases';
import EventsPanel from './EventsPanel';

const opener = page.getByRole('button', { name: 'Open test case…' });

async function open() {
  const { lab, server } = fakeLab();
  show(() => (
    <>
      <EventsPanel lab={lab} />
      <PlaceNotice lab={lab} place="playback" />
    </>
  ));
  await expect.element(opener).toBeEnabled();
  return { lab, server };
}

it('is one stop of the Tab key', async () => {
  const { server } = await open();
  for (const tick of [1, 2, 3]) {
    server.tell({ type: 'event', ...eventAt(tick, 'goal') });
  }
  const events = page.getByRole('button', { name: /^Why: / });
  await expect.poll(() => events.all().length).toBe(3);
  const stops = (): number =>
    events.elements().filter((one) => one.getAttribute('tabindex') === '0').length;
  expect(stops()).toBe(1);
  (events.nth(2).element() as HTMLElement).focus();
  await userEvent.keyboard('{ArrowUp}');
  await expect.element(events.nth(1)).toHaveFocus();
  await userEvent.keyboard('{Home}');
  await expect.element(events.nth(0)).toHaveFocus();
  expect(stops()).toBe(1);
});

it('sends a test case, and shows why the server refuses it', async () => {
  const { server } = await open();
  const field = page.getByLabelText('File of the test case');
  await userEvent.upload(field, new File(['no case'], 'a.json'));
  await expect.poll(() => server.command('open_case')?.case).toBe('no case');
  server.refuse('bad_case', 'test case: expected a value');
  const notice = page.getByRole('alert');
  await expect.element(notice).toHaveTextContent('test case: expected a value');
  await page.getByRole('button', { name: 'Dismiss' }).click();
  await userEvent.upload(field, new File([' '.repeat(65537)], 'a.json'));
  await expect.element(notice).toHaveTextContent('too large: the limit is 64 KiB');
  expect(server.sent.length).toBe(1);
});

it('lets only the operator open a test case', async () => {
  const { lab, server } = await open();
  server.hello({ role: 'viewer' });
  await expect.element(opener).toBeDisabled();
  // A file that is dropped on the page.
  await openCase(lab, new File(['{}'], 'a.json'));
  await expect.element(page.getByText('Take control to open a test case.')).toBeVisible();
  expect(server.sent).toEqual([]);
});
