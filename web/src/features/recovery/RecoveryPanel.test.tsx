import { createSignal, Show } from 'solid-js';
import { expect, it } from 'vitest';
import { page, userEvent } from 'vitest/browser';
import { fakeLab, refusal, show } from '../../lab/testingLab';
import type {
  ControllerName,
  RecoveryCell,
  RecoveryQuery,
  RecoveryReport,
} from '../../net/protocol.gen';
import RecoveryPanel from './RecoveryPanel';

const reportOf = (change: Partial<RecoveryReport> = {}): RecoveryReport => ({
  id: 'recovery-1',
  stage: 'done',
  message: null,
  done: 1,
  planned: 1,
  session: 'main',
  trial: 1,
  map: 'colon',
  kind: 'place',
  controllers: ['rl'],
  names: ['rl'],
  grid: 4,
  repeats: 1,
  seed: 1,
  within_s: 60,
  tick: 250,
  bead_m: [0, -0.3],
  goal_m: null,
  cells: [],
  basins: [],
  differences: [],
  ...change,
});

const cellOf = (number: number, controller: ControllerName, delivered: number): RecoveryCell => ({
  ...{ cell: number, controller, delivered, late: 0, lost: 2 - delivered, repeats: 2 },
  ...{ x_m: 0.02 * number, y_m: -0.35, size_m: 0.02, direction_rad: null, strength: null },
  ...{ at_s: null, delivered_wilson95: [0, 1], time_s_median: null, why: null },
});

it('sends what is chosen, and shows why the server refuses it', async () => {
  let query: RecoveryQuery | undefined;
  const { lab, server } = fakeLab({
    'POST /api/recoveries': (body) => {
      query = JSON.parse(body) as RecoveryQuery;
      return query.grid > 24
        ? refusal('grid makes 200000 trials', 'grid')
        : refusal('no goal is set', 'tick');
    },
  });
  show(() => <RecoveryPanel lab={lab} />);
  const start = page.getByRole('button', { name: /^Map from/ });
  const refused = page.getByText(/^(no goal is set|grid makes)/);
  await expect.element(start).toBeEnabled();
  server.state({ tick: 250, newest_tick: 250, sim_time_s: 2 });
  await expect.element(start).toHaveTextContent('Map from 2.0 s');
  await start.click();
  await expect.element(refused).toHaveTextContent('no goal is set');
  expect(query).toMatchObject({ session: 'main', tick: 250, kind: 'place', grid: 16, repeats: 1 });

  const columns = page.getByLabelText('Columns');
  // In the foot of the panel, with the button. Nothing is measured yet, so no time is said.
  const size = page.getByTestId('recovery-size');
  await expect.element(size).toHaveTextContent(/^At most \d+ trials$/);
  expect(size.element().parentElement).toBe(start.element().parentElement);
  await columns.fill('3');
  await start.click();
  await expect
    .element(columns)
    .toHaveAccessibleDescription('“3” must be a whole number from 4 to 96.');
  expect(query).toMatchObject({ grid: 16 });
  await columns.fill('96');
  await page.getByLabelText('Try RL').click();
  await start.click();
  await expect.element(columns).toHaveAccessibleDescription('grid makes 200000 trials');
  expect(query).toMatchObject({ grid: 96, controllers: ['errt', 'attractor'] });

  for (const name of ['Try ERRT', 'Try Attractor']) await page.getByLabelText(name).click();
  await start.click();
  await expect.element(page.getByText('Choose at least one controller.')).toBeVisible();
});

it('shows a recovery map of another map only when it is chosen, and says so', async () => {
  const report = reportOf();
  const { lab, server } = fakeLab({
    'GET /api/recoveries/recovery-1': () => report,
  });
  server.lists({ recoveries: [report] });
  show(() => <RecoveryPanel lab={lab} />);
  const choice = page.getByLabelText('Recovery map', { exact: true });
  await expect.element(choice).toHaveTextContent('1: Put elsewhere, colon, another map');
  await expect.element(page.getByTestId('recovery-progress')).not.toBeInTheDocument();
  await choice.selectOptions('recovery-1');
  const shown = page.getByTestId('recovery-progress');
  await expect.element(shown).toHaveTextContent('another map than that of the session');
  server.scene({ map: 'colon' });
  await expect.element(shown).toHaveTextContent(/^Put elsewhere on colon from/);
  server.scene({ map: 'posts' });
  await expect.element(shown).not.toBeInTheDocument();
});

it('forgets what was chosen when the map changes behind a closed tab', async () => {
  const there = reportOf({ cells: [cellOf(0, 'rl', 2)] });
  const here = reportOf({ id: 'recovery-2', map: 'posts', cells: [cellOf(0, 'rl', 2)] });
  const { lab, server } = fakeLab({
    'GET /api/recoveries/recovery-1': () => there,
    'GET /api/recoveries/recovery-2': () => here,
    'GET /api/recoveries/recovery-1/cells/0': () => ({ trials: [] }),
  });
  server.lists({ recoveries: [there, here] });
  server.scene({ map: 'colon' });
  const [isOpen, setOpen] = createSignal(true);
  show(() => (
    <Show when={isOpen()}>
      <RecoveryPanel lab={lab} />
    </Show>
  ));
  await page.getByLabelText('Recovery map', { exact: true }).selectOptions('recovery-1');
  const figure = page.getByRole('application', { name: /^RL: cells/ });
  await expect.element(figure).toBeVisible();
  (figure.element() as unknown as SVGElement).focus();
  await userEvent.keyboard('{ArrowRight}');
  await expect.element(page.getByTestId('recovery-cell')).toBeVisible();
  setOpen(false);
  server.scene({ map: 'posts' });
  await expect.poll(() => lab.scene()?.map).toBe('posts');
  setOpen(true);
  await expect
    .element(page.getByTestId('recovery-progress'))
    .toHaveTextContent(/^Put elsewhere on posts from/);
  await expect.element(page.getByTestId('recovery-cell')).not.toBeInTheDocument();
});

it('brings the progress of a started map into sight', async () => {
  await page.viewport(414, 240);
  const report = reportOf({ map: 'posts', stage: 'running' });
  const { lab, server } = fakeLab({
    'POST /api/recoveries': () => report,
    'GET /api/recoveries/recovery-1': () => report,
  });
  server.scene({ map: 'posts' });
  show(() => <RecoveryPanel lab={lab} />);
  await page.getByRole('button', { name: /^Map from/ }).click();
  server.lists({ recoveries: [report] });
  await expect.element(page.getByRole('button', { name: 'Cancel map' })).toBeInViewport();
  await expect.element(page.getByTestId('recovery-progress')).toBeInViewport();
  await page.viewport(414, 896);
});

it('keeps what is pressed while a map goes on', async () => {
  const before = reportOf({ map: 'posts', stage: 'running', cells: [cellOf(0, 'rl', 1)] });
  const cells = [cellOf(0, 'rl', 2), cellOf(1, 'rl', 2)];
  let report = before;
  const { lab, server } = fakeLab({ 'GET /api/recoveries/recovery-1': () => report });
  server.lists({ recoveries: [before] });
  server.scene({ map: 'posts' });
  show(() => <RecoveryPanel lab={lab} />);
  const shapes = () => [...document.querySelectorAll('.recovery-thumb .cell')];
  await expect.poll(() => shapes().length).toBe(1);
  const [pressed] = shapes();
  report = { ...before, done: 2, cells };
  server.lists({ recoveries: [report] });
  await expect.poll(() => shapes().length).toBe(2);
  expect(shapes()[0]).toBe(pressed);
});

it('says how large the area is only when all of the map is tried', async () => {
  const basin = {
    ...{ controller: 'rl', trials: 10, delivered: 10, share: 1, share95: [0.72, 1] },
    ...{ area_m2: 0.0552, area95_m2: [0.04, 0.0552] },
  } satisfies RecoveryReport['basins'][number];
  const reports = (['cancelled', 'done'] as const).map((stage, index) =>
    reportOf({ id: `recovery-${index + 1}`, map: 'posts', stage, basins: [basin] }),
  );
  const { lab, server } = fakeLab(
    Object.fromEntries(reports.map((one) => [`GET /api/recoveries/${one.id}`, () => one])),
  );
  server.lists({ recoveries: reports });
  server.scene({ map: 'posts' });
  show(() => <RecoveryPanel lab={lab} />);
  const area = page.getByText('552 cm²');
  await expect.element(area).toBeVisible();
  await page.getByLabelText('Recovery map', { exact: true }).selectOptions('recovery-1');
  await expect.element(page.getByTestId('recovery-progress')).toHaveTextContent('cancelled');
  await expect.element(page.getByText('RL still delivers in 100 %')).toBeVisible();
  await expect.element(area).not.toBeInTheDocument();
});

it('shows each controller or the difference of two, and goes from cell to cell by keys', async () => {
  const report = reportOf({
    map: 'posts',
    controllers: ['rl', 'errt'],
    names: ['rl', 'errt'],
    cells: [cellOf(0, 'rl', 2), cellOf(1, 'rl', 0), cellOf(0, 'errt', 0), cellOf(1, 'errt', 2)],
  });
  const { lab, server } = fakeLab({
    'GET /api/recoveries/recovery-1': () => report,
    'GET /api/recoveries/recovery-1/cells/1': () => ({ trials: [] }),
  });
  server.lists({ recoveries: [report] });
  server.scene({ map: 'posts' });
  show(() => <RecoveryPanel lab={lab} />);
  const rl = page.getByRole('application', { name: /^RL: cells/ });
  await expect.element(rl).toBeVisible();
  await page.getByRole('button', { name: /^ERRT/ }).click();
  const errt = page.getByRole('application', { name: /^ERRT: cells/ });
  (errt.element() as unknown as SVGElement).focus();
  await userEvent.keyboard('{ArrowRight}{ArrowRight}');
  await expect.element(page.getByTestId('recovery-cell')).toHaveTextContent('2 delivered');
  await page.getByLabelText('Show').selectOptions('RL minus ERRT');
  await expect
    .element(page.getByRole('application', { name: /^RL minus ERRT: cells/ }))
    .toBeVisible();
  expect(
    [...document.querySelectorAll('[role=application] .cell')].map((one) =>
      one.getAttribute('data-kind'),
    ),
  ).toEqual(['first', 'second']);
});
