import { expect, it } from 'vitest';
import { page } from 'vitest/browser';
import { show } from '../lab/testingLab';
import { WorkspaceHint } from './WorkspaceHint';

it('says first what the map shows, if a press opens a part of it', async () => {
  const press = { shown: 'Where RL still delivers', words: 'a cell', at: () => undefined };
  show(() => <WorkspaceHint steers={false} scene={false} press={press} />);
  await expect
    .element(page.getByText(/deliver/))
    .toHaveTextContent('Where RL still delivers: click a cell');
  const [first] = document.querySelectorAll('.hint-words');
  expect(first?.textContent).toContain('Where RL');
  await expect.element(page.getByText('Click to set the goal')).not.toBeInTheDocument();
});
