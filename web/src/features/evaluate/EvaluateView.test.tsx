import { expect, it } from 'vitest';
import { page } from 'vitest/browser';
import { fakeLab, refusal, show } from '../../lab/testingLab';
import EvaluateView from './EvaluateView';
import { cellOf, reportOf, ROW, summaryOf } from './testing';

const PAPER = {
  section: '§V-A',
  printed: '29 of 30',
  episodes: 30,
  successes: 29,
  successes_wilson95: [0.83, 0.99] as [number, number],
  tracking_error_mean_m: 0.01,
  tracking_error_max_x_m: null,
  tracking_error_max_y_m: null,
};

it('shows rows as they come, those of the paper, curves and failures', async () => {
  const query = {
    ...summaryOf().query,
    vary: [{ name: 'friction', from: 0.1, to: 0.2, count: 2 }],
  };
  const varied = (value: number) => [{ name: 'friction', value }];
  const cells = [
    cellOf({ controller: 'errt', varied: varied(0.1), paper: PAPER, done: 10 }),
    cellOf({ controller: 'errt', varied: varied(0.2), done: 4, delivered: 3 }),
  ];
  const running = summaryOf({ query, cells, rows_done: 1 });
  const { lab, server } = fakeLab({
    'GET /api/evaluations/evaluation-3': () =>
      reportOf({
        ...running,
        rows: [ROW],
        failures: [
          {
            cell: 0,
            index: 7,
            seed: '11400714819323198492',
            start_m: [-0.2, -0.3],
            goal_m: [0.1, -0.4],
            reached: false,
            outcome: 'stopped',
            trouble: null,
            refusal: null,
            steps: 150,
            disturbances: 0,
          },
        ],
      }),
    'DELETE /api/evaluations/evaluation-3': () => refusal('too late'),
  });
  server.lists({ evaluations: [summaryOf({ id: 'evaluation-2', stage: 'failed' }), running] });
  lab.address.show('evaluate');
  show(() => <EvaluateView lab={lab} />);
  const results = page.getByRole('region', { name: 'Results' });
  const rows = (): string[] =>
    [...(results.element() as HTMLElement).querySelectorAll('tbody tr')].map((row) =>
      [...row.children].map((cell) => cell.textContent).join(' | '),
    );
  await expect
    .poll(rows)
    .toEqual([
      expect.stringMatching(
        /^ERRTposts \| .*0\.1 \| 0 \| 29\/30.* \| 28\/30.* \| 1\.45\.0 · 6\.5 \| .* \| 2\.37\.5$/,
      ),
      expect.stringMatching(/^paper, §V-A: “29 of 30” \| 29\/30.* \| – \| 1\.0 \| – \| – \| –$/),
      expect.stringMatching(/^ERRTposts \| .*0\.2 \| 0 \| 4 of 10 episodes, 3 delivered so far$/),
    ]);
  const heads = results.getByRole('columnheader');
  await expect.element(heads.nth(1)).toHaveTextContent('Varied');
  expect(heads.all()).toHaveLength(9);
  await expect
    .element(page.getByRole('img', { name: /^Delivered over / }))
    .toHaveAccessibleName(/ERRT 93 \(79 to 98\)/);

  await page.getByRole('button', { name: /^Set it up: episode 7 of ERRT, posts/ }).click();
  expect(lab.address.view()).toBe('laboratory');
  expect(server.command('load_scenario')).toMatchObject({ map: 'posts', controller: 'errt' });

  await page.getByRole('button', { name: 'Cancel' }).click();
  await expect.element(page.getByText('too late')).toBeVisible();
  // A refusal stays with its evaluation.
  await page.getByRole('button', { name: /^2/ }).click();
  await expect.element(page.getByRole('heading', { name: /^Evaluation 2/ })).toBeVisible();
  await expect.element(page.getByText('too late')).not.toBeInTheDocument();
});
