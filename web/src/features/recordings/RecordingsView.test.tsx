import { expect, it } from 'vitest';
import { page, userEvent } from 'vitest/browser';
import { type Answers, fakeServer, refusal, show } from '../../lab/testingLab';
import type { RecordingFile, RecordingTitle } from '../../net/protocol.gen';
import RecordingsView from './RecordingsView';

const content = { maps: [], controllers: [], delivered: 0, not_delivered: 0, duration_s: 0 };

const recordingOf = (session: string, change: Partial<RecordingFile> = {}): RecordingFile => ({
  id: `1-${session}`,
  session,
  started: '2026-11-28T10:00:00Z',
  bytes: 7000,
  log_bytes: null,
  live: false,
  title: null,
  content,
  ...change,
});

const row = (session: string) => page.getByRole('row').filter({ hasText: `${session}, ` });
const chosen = page.getByRole('complementary', { name: 'Chosen recording' });

/** The server keeps titles and deletes. */
function open(...names: string[]) {
  let files = names.map((name) => recordingOf(name, { live: name === 'live' }));
  const answers: Answers = { 'GET /api/recordings': () => ({ recordings: files }) };
  for (const { id } of files) {
    answers[`PATCH /api/recordings/${id}`] = (body) => {
      const title = ((JSON.parse(body) as RecordingTitle).title ?? '').trim();
      if (title.length > 80) return refusal('the title has 81 characters, the limit is 80');
      files = files.map((one) => (one.id === id ? { ...one, title: title || null } : one));
      return files.find((one) => one.id === id);
    };
    answers[`DELETE /api/recordings/${id}`] = () => {
      files = files.filter((one) => one.id !== id);
      return null;
    };
  }
  fakeServer(answers);
  show(() => <RecordingsView session="other" tick={0} maps={['posts']} />);
}

it('names a recording, also on a phone', async () => {
  await page.viewport(390, 844);
  open('anna');
  const head = row('anna').getByRole('rowheader');
  await expect.element(head).toHaveTextContent('Not run');
  const renamer = chosen.getByRole('button', { name: /^Rename / });
  const field = chosen.getByRole('textbox', { name: 'Title of anna' });
  const rename = async (title: string, key: string): Promise<void> => {
    (renamer.element() as HTMLElement).focus();
    await userEvent.keyboard('{Enter}');
    await expect.element(field).toHaveFocus();
    await field.fill(title);
    await userEvent.keyboard(key);
  };
  await rename(' Second try ', '{Enter}');
  await expect.element(renamer).toHaveFocus();
  await expect.element(head).toHaveTextContent('Second try');
  await expect.element(head).not.toHaveTextContent('Not run');
  await rename('Third try', '{Escape}');
  await expect.element(renamer).toHaveFocus();
  await expect.element(head).toHaveTextContent('Second try');
  // The server's reason is shown, and what was typed stays.
  await rename('x'.repeat(81), '{Enter}');
  await expect.element(page.getByRole('alert')).toHaveTextContent('the limit is 80');
  await expect.element(field).toHaveValue('x'.repeat(81));
  await chosen.getByRole('button', { name: 'Cancel' }).click();
  expect(document.documentElement.scrollWidth - window.innerWidth, 'px beside the window').toBe(0);
  await rename('', '{Enter}');
  await expect.element(head).toHaveTextContent('Not run');
  await page.viewport(1280, 800);
});

it('deletes a recording after a question', async () => {
  open('newest', 'deleted', 'kept', 'live');
  const remover = chosen.getByRole('button', { name: /^Delete / });
  const keep = chosen.getByRole('button', { name: /^Keep / });
  await row('deleted').getByRole('button').click();
  await expect.element(remover).toBeVisible();
  for (const key of ['{Enter}', '{Escape}']) {
    (remover.element() as HTMLElement).focus();
    await userEvent.keyboard('{Enter}');
    await expect.element(keep).toHaveFocus();
    await userEvent.keyboard(key);
    await expect.element(keep).not.toBeInTheDocument();
    await expect.element(remover).toHaveFocus();
  }
  await userEvent.keyboard('{Enter}');
  (chosen.getByRole('button', { name: /^Yes, / }).element() as HTMLElement).focus();
  await userEvent.keyboard('{Enter}');
  await expect.element(row('deleted')).not.toBeInTheDocument();
  await expect.element(row('kept').getByRole('button')).toHaveFocus();
  await expect.element(row('newest')).toBeVisible();
  // What is being written cannot be deleted.
  await row('live').getByRole('button').click();
  await expect.element(chosen.getByRole('button', { name: /^Rename / })).toBeVisible();
  expect(chosen.getByRole('button', { name: /^Delete / }).elements()).toEqual([]);
});

it('asks for no picture of a map that the server does not have', async () => {
  const on = (map: string) => recordingOf(map, { content: { ...content, maps: [map] } });
  fakeServer({ 'GET /api/recordings': () => ({ recordings: [on('posts'), on('deleted')] }) });
  show(() => <RecordingsView session="other" tick={0} maps={['posts']} />);
  const picture = (map: string) => row(map).element().querySelector('.map-picture span');
  await expect.element(row('posts')).toBeVisible();
  expect(picture('posts')).not.toBeNull();
  expect(picture('deleted')).toBeNull();
});
